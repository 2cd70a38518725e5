#pragma once

#include <map>

#include "planner/base/id.h"
#include "planner/numeric/rational.h"

namespace assay::algebra {

// A column of linear forms: a variable, or a non-linear product that is treated like a variable.
using ColumnId = Id<struct LinearColumnTag>;

// The linear form r1*v1 + r2*v2 + ... + constant, in exact rational numbers.
struct LinearForm {
  std::map<ColumnId, numeric::Rational> coefficients = {};  // none is 0
  numeric::Rational constant = {};

  bool IsConstant() const { return coefficients.empty(); }
  numeric::Rational CoefficientOf(ColumnId column) const;
  void Add(ColumnId column, const numeric::Rational& coefficient);
  LinearForm Without(ColumnId column) const;

  auto operator<=>(const LinearForm&) const = default;
};

LinearForm FormOf(ColumnId column);
LinearForm operator-(const LinearForm& a);
LinearForm operator+(const LinearForm& a, const LinearForm& b);
LinearForm operator-(const LinearForm& a, const LinearForm& b);
LinearForm operator*(const numeric::Rational& r, const LinearForm& a);

}  // namespace assay::algebra
