#pragma once

#include <vector>

#include "planner/algebra/normal_forms/normal_form.h"

namespace assay::algebra {

// Writes the terms of a normal form, one by one, as an expression with the midpoints of their
// coefficients. A term for which IsRoundingAlone holds is left out.
class SumWriter {
 public:
  void BeginTerm(const Interval& coefficient);
  void Multiply(const NormalForm::Factor& factor);
  Expression Finish();

 private:
  void EndTerm();

  std::vector<Expression> terms_;
  std::vector<Expression> factors_;  // factors of the current term
  bool is_rounding_alone_ = false;
};

Expression ToExpression(const NormalForm& form);

}  // namespace assay::algebra
