#include "planner/algebra/normal_forms/normal_form.h"

#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {

bool IsRoundingAlone(const Interval& coefficient) {
  return !IsSingle(coefficient) && Contains(coefficient, 0);
}

}  // namespace assay::algebra
