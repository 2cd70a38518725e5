#pragma once

#include "planner/base/input_files/document.h"
#include "planner/domain/units/units.h"
#include "planner/domain/workcell/uncertainty_operations.h"

namespace assay::domain {

// Reads the sections `sensors`, `verifications` and `recoveries` of a workcell file
// (models/workcells/README.md). Each section may be missing. Throws InputError for invalid content,
// and for an error that a verification signals but no recovery answers.
UncertaintyOperations ReadUncertaintyOperations(const Value& root, const Units& units);

}  // namespace assay::domain
