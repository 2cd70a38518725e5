#pragma once

#include <span>
#include <vector>

#include "planner/algebra/forms/normal_form.h"

namespace assay::algebra {

// A normal form compiled to a list of steps that are executed one after another. It is made for
// many evaluations (derivatives.h). Factors shared by several terms are factored out greedily, as
// in Horner's scheme: c*x*y + d*x*z becomes x*(c*y + d*z). The result costs less to evaluate and,
// because interval arithmetic is sub-distributive, never gives a wider interval. A variable's
// number is its place in the list of variables that was given to Compile.
struct CompiledForm {
  struct Step {
    // Sums and products have two operands. A quotient is compiled as the product with a reciprocal.
    // The sine and cosine of one angle refer to each other.
    Operator op = Operator::kConstant;
    int a = -1;  // the step of the first operand; the number of a constant or variable
    int b = -1;  // the step of the second operand; for kSin (kCos) the step of the cosine (sine)
    int exponent = 0;  // only for kPower
  };
  std::vector<Step> steps;  // the last step gives the value
  std::vector<Interval> constants;
  std::vector<bool> affine;  // indexed by variable: affine in it while all others are fixed
};

// Compiles a normal form. `variables` lists, in increasing order, at least all variables that occur
// in the form.
CompiledForm Compile(const NormalForm& form, std::span<const VariableId> variables);

// Returns the variables of an atom, in increasing order. It gives the same result as VariablesOf,
// and is faster for atoms like x and sin(x).
std::vector<VariableId> VariablesOfAtom(const Expression& atom);

}  // namespace assay::algebra
