#pragma once

#include <set>

#include "planner/algebra/linear/constraint_set.h"

namespace assay::algebra {

// SUP(J, H) and INF(J, H): an expression over the variables in `keep` (H) that is never less (never
// greater) than J wherever the constraints hold (Bledsoe 1975; Shostak 1977; non-linear rules in
// the spirit of Brooks 1981; Spar, "Constraints at the Uncertainty-Reduction Level"). Exact for
// linear J and linear constraints with keep empty; there the arithmetic is rational, and only the
// answer is rounded, outward. With keep empty a non-linear J is never bounded worse than by
// interval arithmetic on J as it stands. +infinity (-infinity) if nothing bounds J; if the
// constraints contradict each other, SUP may be below INF. A question that takes more than
// LinearSupInf::kMostSteps steps is answered by a number, also if there are variables to keep. The
// numbers of a symbolic answer are rounded so that it stays a bound; where that cannot be done, for
// a variable without bounds, that part of the answer is left out. Every variable of J and of the
// constraints has an interval in the constraints' box.
Expression Sup(const Expression& j, const std::set<VariableId>& keep,
               const ConstraintSet& constraints);
Expression Inf(const Expression& j, const std::set<VariableId>& keep,
               const ConstraintSet& constraints);

// The box made smaller by what the linear inequalities say of each variable: contains every point
// that the constraints allow. A variable of which they say contradictory things keeps its interval.
std::vector<Interval> TightenedBox(const ConstraintSet& constraints);

}  // namespace assay::algebra
