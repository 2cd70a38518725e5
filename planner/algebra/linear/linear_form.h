#pragma once

#include <map>

#include "planner/algebra/numeric/rational.h"
#include "planner/base/id.h"

namespace assay::algebra {

// What linear forms are linear in: a variable, or a non-linear product that is treated as one.
using ColumnId = Id<struct LinearColumnTag>;

// r1*v1 + r2*v2 + ... + constant, in exact numbers.
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
