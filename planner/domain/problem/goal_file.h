#pragma once

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/units/units.h"

namespace assay::domain {

// Reads a scenario's list of goals, `assembled: ` (mating_file.h) or `located: {part, stable}`,
// into a problem that has its parts. Throws InputError for an invalid goal, and for one that is
// given twice.
void ReadGoals(const Value& goals, const Units& units, Problem& problem);

}  // namespace assay::domain
