#include "planner/algebra/sup_inf/linear_form.h"

namespace assay::algebra {

numeric::Rational LinearForm::CoefficientOf(ColumnId column) const {
  const auto found = coefficients.find(column);
  return found == coefficients.end() ? numeric::Rational() : found->second;
}

void LinearForm::Add(ColumnId column, const numeric::Rational& coefficient) {
  if (coefficient.IsZero()) return;
  const auto [place, is_new] = coefficients.emplace(column, coefficient);
  if (is_new) return;
  place->second = place->second + coefficient;
  if (place->second.IsZero()) coefficients.erase(place);
}

LinearForm LinearForm::Without(ColumnId column) const {
  LinearForm rest = *this;
  rest.coefficients.erase(column);
  return rest;
}

LinearForm FormOf(ColumnId column) { return {.coefficients = {{column, 1}}, .constant = {}}; }

LinearForm operator-(const LinearForm& a) { return numeric::Rational(-1) * a; }

LinearForm operator+(const LinearForm& a, const LinearForm& b) {
  LinearForm sum = a;
  for (const auto& [column, coefficient] : b.coefficients) sum.Add(column, coefficient);
  sum.constant = sum.constant + b.constant;
  return sum;
}

LinearForm operator-(const LinearForm& a, const LinearForm& b) { return a + -b; }

LinearForm operator*(const numeric::Rational& r, const LinearForm& a) {
  if (r.IsZero()) return {};
  LinearForm product = a;
  for (auto& [column, coefficient] : product.coefficients) coefficient = r * coefficient;
  product.constant = r * product.constant;
  return product;
}

}  // namespace assay::algebra
