#pragma once

#include <vector>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// As ascent.h, where inequalities hold: in doubles, without any promise.

// A point of the problem's box that violates the inequalities as little as steps across the
// violated ones bring it to.
std::vector<double> ApproachFeasible(std::vector<double> start, Probe& probe);

// Uphill from a feasible point, along the inequalities that stand in the way.
std::vector<double> AscendFeasibly(std::vector<double> start, Probe& probe);

}  // namespace assay::algebra
