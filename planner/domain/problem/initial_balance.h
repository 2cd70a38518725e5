#pragma once

#include <vector>

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"
#include "planner/domain/units/units.h"

namespace assay::domain {

// Checks that no part falls over before the first action. The centre of mass of each part, and the
// common centre of mass of all parts that are assembled with it at the start, must be over what
// they stand on. A fixture (Part::clamp) presses only while a part is mated, so it does not count.
// The check is necessary for parts that are assembled, but not sufficient: a part may still lean
// out of its hole. `entries` are the entries of the parts in the file. Throws InputError.
void CheckInitialBalance(const Problem& problem, const Units& units,
                         const std::vector<Value>& entries);

}  // namespace assay::domain
