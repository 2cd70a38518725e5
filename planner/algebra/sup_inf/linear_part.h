#pragma once

#include <optional>
#include <vector>

#include "planner/algebra/sup_inf/constraint_set.h"
#include "planner/algebra/sup_inf/linear_sup_inf.h"

namespace assay::algebra {

// Returns e as a linear form if it is linear as it is written. The column of a variable has the
// variable's number.
std::optional<LinearForm> ExactLinearForm(const Expression& e);

// The constraints of a set, divided into linear ones and others.
struct LinearPart {
  std::vector<LinearForm> at_most_zero;  // the box's ends and the linear inequalities
  std::vector<Inequality> others;
};
LinearPart LinearPartOf(const ConstraintSet& constraints);

// Returns the finite ends of the range as linear forms that are at most 0.
std::vector<LinearForm> EndsOf(ColumnId column, const Interval& range);

// Returns the intersection of a and b. The intersection can be empty where constraints contradict
// each other. The result is then a, which is conservative.
Interval Narrowed(const Interval& a, const Interval& b);

// Returns the variable's interval, narrowed to its SUP and INF.
Interval TightenedInterval(VariableId variable, const Interval& interval, const LinearSupInf& core);

}  // namespace assay::algebra
