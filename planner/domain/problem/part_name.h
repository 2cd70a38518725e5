#pragma once

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {

// Returns the part of this name. Throws InputError if the problem has none.
PartId ReadPartName(const Value& value, const Problem& problem);

}  // namespace assay::domain
