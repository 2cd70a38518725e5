#pragma once

#include <vector>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// Searches for points at which a form is large and the inequalities hold. As in ascent.h, the
// search uses doubles and guarantees nothing.

// Returns a point of the problem's box that violates the inequalities as little as possible. It is
// found by steps across the violated inequalities.
std::vector<double> ApproachFeasible(std::vector<double> start, Probe& probe);

// Ascends from a feasible point. A step follows the inequalities that block it.
std::vector<double> AscendFeasibly(std::vector<double> start, Probe& probe);

}  // namespace assay::algebra
