#pragma once

#include "planner/base/document.h"
#include "planner/domain/problem.h"
#include "planner/domain/units.h"

namespace assay::domain {

// Reads `{held, fixed, features, pose, mating_vector}`, as a scenario writes the matings of its
// goals and of its start, between parts of the problem. Of the problem it needs the parts with
// their models, the clearance and the workcell. Throws InputError, also if the features do not meet
// in the mated pose or the parts overlap there or on the way.
Mating ReadMating(const Value& value, const Problem& problem, const Units& units);

}  // namespace assay::domain
