#pragma once

#include <string>
#include <vector>

#include "sim/report/findings/findings.h"

namespace assay::report {

// A property in which the cells of a sweep can differ.
struct CellAxis {
  const char* name;
  std::string (*value)(const sweep::CellRecord&);
};

// Returns the axes on which the cells have different values, in the order of the grid. Sections
// name the values of these axes.
std::vector<CellAxis> AxesThatDiffer(const std::vector<CellFindings>& cells);

// Returns, for the head of a section, the values that all cells have in common: "scenario a.yaml,
// clearance 0.5 mm, ...".
std::string CommonText(const std::vector<CellFindings>& cells);

// Returns the name that sections give a cell, with its values on these axes: "Cell 3: uniform,
// errors × 0.1".
std::string CellName(const sweep::CellRecord& cell, const std::vector<CellAxis>& axes);

// Returns, for a section, a short description of the cell's plan: "2 actions, proved".
std::string PlanText(const sweep::CellRecord& cell);

}  // namespace assay::report
