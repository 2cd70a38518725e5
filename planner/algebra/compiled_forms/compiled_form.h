#pragma once

#include <vector>

#include "planner/algebra/operators/operator.h"
#include "planner/base/interval.h"

namespace assay::algebra {

// A normal form compiled to a list of steps that are executed one after another. It is made for
// many evaluations (derivatives.h, compiler.h). Factors shared by several terms are factored out
// greedily, as in Horner's scheme: c*x*y + d*x*z becomes x*(c*y + d*z). The result costs less to
// evaluate and, because interval arithmetic is sub-distributive, never gives a wider interval. A
// variable's number is its place in the list of variables that was given to Compile.
struct CompiledForm {
  struct Step {
    // Sums and products have two operands. A quotient is compiled as the product with a reciprocal.
    Operator op = Operator::kConstant;
    int a = -1;        // the step of the first operand; the number of a constant or variable
    int b = -1;        // the step of the second operand, or of the companion (operator_rule.h)
    int exponent = 0;  // only for kPower
    bool may_be_undefined = false;
  };
  std::vector<Step> steps;  // the last step gives the value
  std::vector<Interval> constants;
  std::vector<bool> affine;  // indexed by variable: affine in it while all others are fixed
};

}  // namespace assay::algebra
