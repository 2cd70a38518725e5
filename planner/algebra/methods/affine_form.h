#pragma once

#include <span>

#include "planner/algebra/expression/expression.h"
#include "planner/base/interval.h"

namespace assay::algebra {

// An expression over a box as a sum of multiples of its variables and a rest that is known only by
// its range (affine arithmetic, Comba and Stolfi 1993): however long the expression is, its affine
// form is short, and keeps which variables it depends on.
struct AffineForm {
  Expression linear;
  Interval rest;  // of the expression less `linear`, at every point of the box: guaranteed
};

// The slopes are those at the middle of the box. Variables that move the expression by less than
// `negligible` of what all of them do go into the rest. The box is by VariableId and finite.
AffineForm AffineFormOf(const Expression& e, std::span<const Interval> box, double negligible);

}  // namespace assay::algebra
