#pragma once

#include <span>
#include <vector>

#include "planner/algebra/forms/normal_form.h"

namespace assay::algebra {

// A normal form as a list of steps to be carried out one after another, made for many evaluations
// (derivatives.h). Factors that several terms share are taken out greedily, as Horner does:
// c*x*y + d*x*z becomes x*(c*y + d*z), which costs less and, by the sub-distributivity of interval
// arithmetic, is never wider. Variables are numbered as in the list they are compiled with.
struct CompiledForm {
  struct Step {
    Operator op = Operator::kConstant;
    int a = -1;        // operand, by step; of kConstant and kVariable: its number
    int b = -1;        // second operand; of kSin: the step of the same angle's cosine; of kCos: of
                       // its sine
    int exponent = 0;  // of kPower
  };
  std::vector<Step> steps;  // the last one gives the value; sums and products have two operands,
                            // a quotient is the product with a reciprocal
  std::vector<Interval> constants;
  std::vector<bool> affine;  // by variable: the form is affine in it while all others stand still
};

// `variables`: in increasing order, all that occur in the form, perhaps more.
CompiledForm Compile(const NormalForm& form, std::span<const VariableId> variables);

// The variables of an atom, in increasing number: as VariablesOf, quick for x, sin(x) and the like.
std::vector<VariableId> VariablesOfAtom(const Expression& atom);

}  // namespace assay::algebra
