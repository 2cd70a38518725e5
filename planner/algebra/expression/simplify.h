#pragma once

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// Normal form (facts in the spirit of Brooks 1981, SIMP): a sum of products; each product a number
// times integer powers of distinct atoms; an atom is a variable, sin or cos of a normal form, or
// what cannot be expanded (sqrt, abs, min, max, a reciprocal) of normal forms. Factors and terms
// are sorted, equal products merged, numbers folded; sin(-e) = -sin e, cos(-e) = cos e; every even
// power of a sine is rewritten by sin^2 = 1 - cos^2. Two expressions with the same normal form are
// equal up to the rounding of their numbers. Expansion stops at `most_terms`: a product that would
// exceed it stays a product, whose sums are atoms. sqrt(e)^2 = e and abs(e)^2 = e^2. Values are
// kept up to rounding of the numbers; what must be rigorous uses NormalForm (normal_form.h), whose
// numbers are intervals.
Expression Simplify(const Expression& e, int most_terms = 20'000);

}  // namespace assay::algebra
