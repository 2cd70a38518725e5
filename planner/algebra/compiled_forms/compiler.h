#pragma once

#include <span>

#include "planner/algebra/compiled_forms/compiled_form.h"
#include "planner/algebra/normal_forms/normal_form.h"

namespace assay::algebra {

// Compiles a normal form. `variables` lists, in increasing order, at least all variables that occur
// in the form.
CompiledForm Compile(const NormalForm& form, std::span<const VariableId> variables);

}  // namespace assay::algebra
