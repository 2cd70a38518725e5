#pragma once

#include <set>

#include "planner/algebra/sup_inf/constraint_set.h"

namespace assay::algebra {

// SUP(J, H) and INF(J, H): return an expression over the variables in `keep` (H) that is never less
// (never greater) than J wherever the constraints hold (Bledsoe 1975; Shostak 1977; non-linear
// rules in the spirit of Brooks 1981; Spar, "Constraints at the Uncertainty-Reduction Level").
// Every variable of J and of the constraints must have an interval in the constraints' box.
//
// For an empty `keep`, the bound of a linear J over linear constraints is exact: the arithmetic is
// rational, and only the answer is rounded, outward. A non-linear J is then never bounded worse
// than by interval arithmetic on J as it is written. The result is +infinity (-infinity) if nothing
// bounds J. If the constraints contradict each other, SUP may be below INF.
//
// A question that takes more than LinearSupInf::kMostSteps steps is answered by a number, even if
// there are variables to keep. The numbers of a symbolic answer are rounded so that it stays a
// bound. For a variable without bounds this may be impossible; that part of the answer is then left
// out.
Expression Sup(const Expression& j, const std::set<VariableId>& keep,
               const ConstraintSet& constraints);
Expression Inf(const Expression& j, const std::set<VariableId>& keep,
               const ConstraintSet& constraints);

// Returns the box tightened by the linear inequalities. It contains every point that the
// constraints allow. A variable for which the inequalities contradict each other keeps its
// interval.
std::vector<Interval> TightenedBox(const ConstraintSet& constraints);

}  // namespace assay::algebra
