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

// The ways in which the arguments of atoms are simplified. The arguments are expressions, and the
// numbers in an expression cannot be intervals.
enum class AtomArguments {
  kExact,    // simplified only where that rounds nothing
  kRounded,  // always simplified, so that the normal form is not rigorous
};

// Returns true if the coefficient may be 0 and differs from 0 only because numbers were rounded.
bool IsRoundingAlone(const Interval& coefficient);

// Returns true if the coefficient of a term is a single finite number.
bool IsNumber(const Interval& coefficient);
// Returns true if the factors of a term are a single variable.
bool IsVariable(const std::vector<NormalForm::Factor>& factors);

}  // namespace assay::algebra
