#pragma once

#include <vector>

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// A sum of products of powers of atoms (simplify.h says of what), with intervals for numbers: the
// expression's value at every point is in the normal form's, whatever was rounded on the way. What
// is exact stays a single number. Sine, cosine, root and so on of numbers are numbers.
struct NormalForm {
  struct Factor {
    // A reciprocal is an atom of its own: kPower with exponent -1. It does not cancel against its
    // base, so that what divides by an interval that holds 0 keeps doing so. A sum that was not
    // expanded is an atom, too.
    Expression atom;
    int exponent = 1;  // positive

    bool operator==(const Factor&) const = default;
  };
  struct Term {
    Interval coefficient;
    std::vector<Factor> factors;  // distinct atoms, by increasing index; empty: the constant term

    bool operator==(const Term&) const = default;
  };
  std::vector<Term> terms;  // distinct factors, in lexicographic order: the constant term first

  bool operator==(const NormalForm&) const = default;
};

// The atoms' arguments are expressions, whose numbers cannot be intervals.
enum class AtomArguments {
  kExact,    // simplified only where that rounds nothing
  kRounded,  // always simplified: the normal form is no longer rigorous
};

// A product is expanded if that takes no more than 100 multiplications of terms for each of
// `most_terms`, and gives no more terms than these.
NormalForm NormalFormOf(const Expression& e, int most_terms = 20'000,
                        AtomArguments arguments = AtomArguments::kExact);

// Whether it may be 0, and is there only because numbers were rounded.
bool IsRoundingAlone(const Interval& coefficient);

// From now on what the normal forms of the pool's expressions have in common is expanded once and
// kept, up to a limit: for many expressions that are made of the same ones. The normal forms are
// the same.
void KeepNormalForms(ExpressionPool& pool);

// ToExpression of the normal form with rounded arguments, without making the form.
Expression SimplifiedExpression(const Expression& e, int most_terms);

// With the coefficients' midpoints; a term that is rounding alone is left out.
Expression ToExpression(const NormalForm& form);

}  // namespace assay::algebra
