#pragma once

#include "planner/base/document/document.h"
#include "planner/domain/problem/units.h"
#include "planner/domain/workcell/uncertainty_operations.h"

namespace assay::domain {

// Reads the sections `sensors`, `verifications` and `recoveries` of a workcell file
// (models/workcells/README.md); each of them may be left out. Throws InputError for what they may
// not hold, also for an error that a verification signals and no recovery answers.
UncertaintyOperations ReadUncertaintyOperations(const Value& root, const Units& units);

}  // namespace assay::domain
