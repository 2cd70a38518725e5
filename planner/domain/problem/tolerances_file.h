#pragma once

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/units/units.h"

namespace assay::domain {

// Reads `{clearance: , friction: , pad_friction: }`, with 0 for missing keys, for a problem that
// has its workcell, clearance and parts. Throws InputError for a tolerance that is below 0 or not
// less than its quantity. Throws also for a tolerance of the clearance with which a part has an
// impossible pocket at the least or the greatest clearance.
Tolerances ReadTolerances(const Value& map, const Units& units, const Problem& problem);

}  // namespace assay::domain
