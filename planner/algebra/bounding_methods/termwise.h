#pragma once

#include <span>

#include "planner/algebra/normal_forms/normal_form.h"

namespace assay::algebra {

// The paper's bound (Spar, "Constraints at the Uncertainty-Reduction Level", after Brooks). Each
// product of the normal form is bounded alone, by interval arithmetic over the box (indexed by
// VariableId), and the bounds are added. This is conservative because a sum lies between the sums
// of its terms' bounds. It is not exact where terms share variables, because no value of a shared
// variable need be the worst for all of these terms.
Interval TermwiseRange(const NormalForm& form, std::span<const Interval> box);

}  // namespace assay::algebra
