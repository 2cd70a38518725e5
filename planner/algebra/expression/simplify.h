#pragma once

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// Returns the normal form of e, after SIMP (Brooks 1981). It is a sum of products. Each product is
// a number times positive integer powers of distinct atoms. An atom is a variable, the sine or
// cosine of a normal form, or an operation on normal forms that cannot be expanded (sqrt, abs, min,
// max, a reciprocal).
//
// Factors and terms are sorted, equal products are merged, and numbers are folded. The rules are
// sin(-e) = -sin e, cos(-e) = cos e, sqrt(e)^2 = e and abs(e)^2 = e^2; every even power of a sine
// is rewritten by sin^2 = 1 - cos^2. A product whose expansion would exceed `most_terms` stays a
// product, and its sums are atoms. Two expressions with the same normal form are equal up to the
// rounding of their numbers. Values are kept up to that rounding. Rigorous computations use
// NormalForm (normal_form.h), whose numbers are intervals.
Expression Simplify(const Expression& e, int most_terms = 20'000);

}  // namespace assay::algebra
