#pragma once

#include <vector>

#include "planner/algebra/linear/linear_form.h"

namespace assay::algebra {

// The greatest value of a linear form.
struct LinearOptimum {
  enum class Kind { kFinite, kUnbounded, kContradiction } kind = Kind::kContradiction;
  Rational value = {};  // of kFinite
};

// Maximizes over the points, of any sign, where each of `at_most_zero` is <= 0. Exact: the simplex
// method in rational numbers, with the pivoting rule of Bland (1977), under which it ends.
LinearOptimum Maximize(const LinearForm& objective, const std::vector<LinearForm>& at_most_zero);

}  // namespace assay::algebra
