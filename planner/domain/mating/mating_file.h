#pragma once

#include "planner/base/document/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/problem/units.h"

namespace assay::domain {

// Reads `{held, fixed, features, pose, mating_vector}`, as a scenario writes the matings of its
// goals and of its start, between parts of the problem, and adds it to the problem unless it is
// there: a mating that is written twice is one. Of the problem it needs the parts with their
// models, the clearance and the workcell. Throws InputError, also if a pair of features cannot meet
// (a shaft meets a hole, a face a face, and holes lie in line) or is given twice; if in the mated
// pose features do not meet, parts overlap or do not touch; or if the motion does not lead along
// the hole from before its mouth, or the parts overlap on the way.
MatingId AddMating(const Value& value, const Units& units, Problem& problem);

// Throws InputError at the `features` of `value`, which says the mating, if no shaft of it is held
// all around by a hole: the certificates of assemble are about shafts in holes.
void RequireShaftInHole(const Value& value, const Problem& problem, MatingId mating);

}  // namespace assay::domain
