#pragma once

#include <map>

#include "planner/algebra/numeric/rational.h"
#include "planner/base/id.h"

namespace assay::algebra {

// A column of linear forms: a variable, or a non-linear product that is treated like a variable.
using ColumnId = Id<struct LinearColumnTag>;

// The linear form r1*v1 + r2*v2 + ... + constant, in exact rational numbers.
struct LinearForm {
  std::map<ColumnId, Rational> coefficients = {};  // none is 0
  Rational constant = {};

  bool IsConstant() const { return coefficients.empty(); }
  Rational CoefficientOf(ColumnId column) const;
  void Add(ColumnId column, const Rational& coefficient);
  LinearForm Without(ColumnId column) const;

  auto operator<=>(const LinearForm&) const = default;
};

LinearForm FormOf(ColumnId column);
LinearForm operator-(const LinearForm& a);
LinearForm operator+(const LinearForm& a, const LinearForm& b);
LinearForm operator-(const LinearForm& a, const LinearForm& b);
LinearForm operator*(const Rational& r, const LinearForm& a);

}  // namespace assay::algebra
