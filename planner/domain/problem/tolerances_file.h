#pragma once

#include "planner/base/document/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/problem/units.h"

namespace assay::domain {

// `{clearance: , friction: , pad_friction: }`, 0 where it is left out, for a problem that has its
// workcell, clearance and parts. Throws InputError for a tolerance that is below 0 or not less than
// what it is of, and for one that leaves a part no sound pocket at an end of the clearances.
Tolerances ReadTolerances(const Value& map, const Units& units, const Problem& problem);

}  // namespace assay::domain
