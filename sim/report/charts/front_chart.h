#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/report/html/element.h"

namespace assay::report {

// A curve between the errors with which everything is proved and those with which not everything
// is.
struct FrontCurve {
  std::string label;                            // empty if there is one curve only
  std::vector<std::array<double, 2>> proved;    // in the units of the axes
  std::vector<std::array<double, 2>> unproved;  // in the units of the axes
};

// The Pareto front of two errors. With several curves, a third error differs from curve to curve.
struct FrontPicture {
  std::array<std::string, 2> axes;  // "hand.xy, mm"
  std::array<double, 2> declared = {};
  std::vector<FrontCurve> curves;
};

// Returns a self-contained drawing. Below and left of a curve everything is proved. One curve alone
// has the proved errors filled, and the errors hatched with which not everything is proved; between
// them nothing was tried.
Element FrontChart(const FrontPicture& picture);

}  // namespace assay::report
