#pragma once

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/units/units.h"

namespace assay::domain {

// Reads `{held, fixed, features, pose, mating_vector}`, the form in which a scenario writes the
// matings of its goals and of its start. Adds the mating to the problem unless it is there already.
// The problem must have its parts with their models, the clearance and the workcell.
//
// Throws InputError if the value is malformed. Throws also if a pair of features is given twice or
// cannot meet: a shaft meets a hole, a face meets a face, and holes lie in line. In the mated pose,
// features must meet, and the parts must touch and not overlap. The motion must lead along the hole
// from before its mouth, and the parts must not overlap on the way.
MatingId AddMating(const Value& value, const Units& units, Problem& problem);

// Throws InputError at the `features` of `value`, the entry of the mating, if none of its shafts is
// held all around by a hole: the certificates of assemble are about shafts in holes.
void RequireShaftInHole(const Value& value, const Problem& problem, MatingId mating);

}  // namespace assay::domain
