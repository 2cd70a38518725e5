#pragma once

#include <vector>

#include "planner/algebra/sup_inf/linear_form.h"

namespace assay::algebra {

// The greatest value of a linear form.
struct LinearOptimum {
  enum class Kind { kFinite, kUnbounded, kContradiction } kind = Kind::kContradiction;
  numeric::Rational value = {};  // only for kFinite
};

// Maximizes `objective` over all points, with coordinates of any sign, at which each form of
// `at_most_zero` is <= 0. The result is exact. The method is the simplex method in rational
// numbers, with the pivoting rule of Bland (1977), under which it terminates.
LinearOptimum Maximize(const LinearForm& objective, const std::vector<LinearForm>& at_most_zero);

}  // namespace assay::algebra
