#pragma once

#include <span>

#include "planner/algebra/expression/expression.h"
#include "planner/base/interval.h"

namespace assay::algebra {

// An expression over a box as a linear combination of its variables plus a rest. Only the range of
// the rest is known (affine arithmetic, Comba and Stolfi 1993). The affine form is short for any
// length of the expression, and it keeps the dependence on the variables.
struct AffineForm {
  Expression linear;
  Interval rest;  // the range of the expression minus `linear` over the box: guaranteed
};

// Returns the affine form of e. Its slopes are the derivatives at the middle of the box. Variables
// whose share in the total variation of the expression is less than `negligible` go into the rest.
// The box is finite and indexed by VariableId.
AffineForm AffineFormOf(const Expression& e, std::span<const Interval> box, double negligible);

}  // namespace assay::algebra
