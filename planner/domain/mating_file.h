#pragma once

#include "planner/base/document.h"
#include "planner/domain/problem.h"
#include "planner/domain/units.h"

namespace assay::domain {

// Reads `{held, fixed, features, pose, mating_vector}`, as a scenario writes the matings of its
// goals and of its start, between parts of the problem, and adds it to the problem unless it is
// there: a mating that is written twice is one. Of the problem it needs the parts with their
// models, the clearance and the workcell. Throws InputError, also if the features do not meet in
// the mated pose or the parts overlap there or on the way.
MatingId AddMating(const Value& value, const Units& units, Problem& problem);

}  // namespace assay::domain
