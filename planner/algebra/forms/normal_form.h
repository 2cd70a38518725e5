#pragma once

#include <vector>

#include "planner/algebra/expression/expression.h"

namespace assay::algebra {

// A sum of products of powers of atoms, with intervals for numbers. The atoms are defined in
// simplify.h. At every point the value of the expression lies in the value of its normal form,
// whatever was rounded on the way. Exact numbers stay single numbers. A function (sine, cosine,
// root) of a number is replaced by a number.
struct NormalForm {
  struct Factor {
    // A reciprocal is an atom: kPower with exponent -1. It does not cancel against its base, so
    // that a division by an interval that contains 0 is never lost. A sum that was not expanded is
    // an atom, too.
    Expression atom;
    int exponent = 1;  // positive

    bool operator==(const Factor&) const = default;
  };
  struct Term {
    Interval coefficient;
    std::vector<Factor> factors;  // distinct atoms by increasing index; none in the constant term

    bool operator==(const Term&) const = default;
  };
  std::vector<Term> terms;  // distinct products, in lexicographic order: the constant term is first

  bool operator==(const NormalForm&) const = default;
};

// The ways in which the arguments of atoms are simplified. Arguments are expressions, whose numbers
// cannot be intervals.
enum class AtomArguments {
  kExact,    // simplified only where that rounds nothing
  kRounded,  // always simplified, so that the normal form is not rigorous
};

// Returns the normal form of e. A product is expanded only if the result has at most `most_terms`
// terms and the expansion takes at most 100 * `most_terms` multiplications of terms.
NormalForm NormalFormOf(const Expression& e, int most_terms = 20'000,
                        AtomArguments arguments = AtomArguments::kExact);

// Returns true if the coefficient may be 0 and differs from 0 only because numbers were rounded.
bool IsRoundingAlone(const Interval& coefficient);

// From this call on, sub-expressions that the pool's expressions share are expanded once, and their
// normal forms are kept, up to a limit. This pays for many expressions with common parts. It does
// not change any normal form.
void KeepNormalForms(ExpressionPool& pool);

// Returns ToExpression of the normal form with rounded arguments, without building that form.
Expression SimplifiedExpression(const Expression& e, int most_terms);

// Writes a normal form as an expression with the midpoints of its coefficients. A term for which
// IsRoundingAlone holds is left out.
Expression ToExpression(const NormalForm& form);

}  // namespace assay::algebra
