#include "planner/algebra/normal_forms/normal_form.h"

#include <cmath>

#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

bool IsRoundingAlone(const Interval& coefficient) {
  return !IsSingle(coefficient) && Contains(coefficient, 0);
}

bool IsNumber(const Interval& coefficient) {
  return coefficient.low == coefficient.high && std::isfinite(coefficient.low);
}

bool IsVariable(const std::vector<NormalForm::Factor>& factors) {
  return factors.size() == 1 && factors[0].exponent == 1 &&
         factors[0].atom.op() == Operator::kVariable;
}

}  // namespace assay::algebra
