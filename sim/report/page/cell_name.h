#pragma once

#include <string>
#include <vector>

#include "sim/report/sections/findings.h"

namespace assay::report {

// What tells cells apart.
struct CellAxis {
  const char* name;
  std::string (*value)(const sweep::CellRecord&);
};

// Those whose values differ between the cells, in the order of the grid.
std::vector<CellAxis> AxesThatDiffer(const std::vector<CellFindings>& cells);

// What all cells have in common: "scenario a.yaml, clearance 0.5 mm, ...".
std::string CommonText(const std::vector<CellFindings>& cells);

// "Cell 3: uniform, errors × 0.1": its values on these axes.
std::string CellName(const sweep::CellRecord& cell, const std::vector<CellAxis>& axes);

// "2 actions, proved"
std::string PlanText(const sweep::CellRecord& cell);

}  // namespace assay::report
