#pragma once

#include <span>

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// Applies the operator, which is no power, to its operands. The number of operands must be the one
// that the operator takes, and at least one.
Expression Apply(Operator op, std::span<const Expression> operands);

// Returns the value of e at a point, which is indexed by VariableId. It is computed in doubles and
// not rounded outward. The value is NaN where a square root or a quotient has no real value.
double Evaluate(const Expression& e, std::span<const double> point);

// Returns an interval that contains every value of e over a box, which is indexed by VariableId. It
// is computed by interval arithmetic on the expression as it is stored.
Interval Evaluate(const Expression& e, std::span<const Interval> box);

}  // namespace assay::algebra
