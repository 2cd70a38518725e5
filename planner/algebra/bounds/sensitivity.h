#pragma once

#include <vector>

#include "planner/algebra/bounds/bounds.h"

namespace assay::algebra {

// The cost of one variable's uncertainty to a bound.
struct Share {
  VariableId variable;
  double cost = 0;  // the improvement of the bound if the variable were at its midpoint
};

// Return the variables and their costs, the greatest cost first. Variables without a cost are left
// out. Costs below the request's gap are left out, too, if they may come from the looseness of the
// bounds.
std::vector<Share> SharesOfSup(const Expression& e, const ConstraintSet& constraints,
                               const BoundRequest& request);
std::vector<Share> SharesOfInf(const Expression& e, const ConstraintSet& constraints,
                               const BoundRequest& request);

// A reduction of a variable's interval, about its midpoint, to `factor` of its width.
struct Tightening {
  VariableId variable;
  double factor = 1;  // in [0, 1)
};

// Return the tightenings of a single variable that achieve SUP < limit (INF > limit). Each
// tightening shrinks the interval of its variable as little as possible (to three digits). The
// mildest tightening comes first. The result is empty if no tightening of a single variable
// suffices, or if none is needed.
std::vector<Tightening> TighteningsToBringSupBelow(double limit, const Expression& e,
                                                   const ConstraintSet& constraints,
                                                   const BoundRequest& request);
std::vector<Tightening> TighteningsToBringInfAbove(double limit, const Expression& e,
                                                   const ConstraintSet& constraints,
                                                   const BoundRequest& request);

}  // namespace assay::algebra
