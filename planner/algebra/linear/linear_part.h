#pragma once

#include <optional>
#include <vector>

#include "planner/algebra/forms/normal_form.h"
#include "planner/algebra/linear/constraint_set.h"
#include "planner/algebra/linear/linear_sup_inf.h"

namespace assay::algebra {

// The form that the expression is, if it is linear as it stands. The column of a variable has the
// variable's number.
std::optional<LinearForm> ExactLinearForm(const Expression& e);

// The same also for what is linear only up to normal form, if nothing was rounded there.
std::optional<LinearForm> LinearFormOf(const Expression& e);

// What a constraint set says in linear terms.
struct LinearPart {
  std::vector<LinearForm> at_most_zero;  // the box's ends and the linear inequalities
  std::vector<Inequality> others;
};
LinearPart LinearPartOf(const ConstraintSet& constraints);

// The finite ends of the range as forms that are at most 0.
std::vector<LinearForm> EndsOf(ColumnId column, const Interval& range);

// What a and b have in common; a if that is nothing, as can be where constraints contradict each
// other and nothing that is said is wrong.
Interval Narrowed(const Interval& a, const Interval& b);

// The variable's interval, narrowed to its SUP and INF.
Interval TightenedInterval(VariableId variable, const Interval& interval, const LinearSupInf& core);

// Of normal forms: a coefficient that is one number; a product that is a variable.
bool IsNumber(const Interval& coefficient);
bool IsVariable(const std::vector<NormalForm::Factor>& factors);

}  // namespace assay::algebra
