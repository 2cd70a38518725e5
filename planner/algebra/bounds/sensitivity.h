#pragma once

#include <vector>

#include "planner/algebra/bounds/bounds.h"

namespace assay::algebra {

// What one variable's uncertainty costs a bound.
struct Share {
  VariableId variable;
  double cost = 0;  // by how much the bound would improve, were the variable at its midpoint
};

// The variables that cost most, first; those are left out that cost nothing, or less than the
// request's gap where the bounds are not known better.
std::vector<Share> SharesOfSup(const Expression& e, const ConstraintSet& constraints,
                               const BoundRequest& request);
std::vector<Share> SharesOfInf(const Expression& e, const ConstraintSet& constraints,
                               const BoundRequest& request);

// A variable's interval, shrunk about its midpoint to `factor` of its width.
struct Tightening {
  VariableId variable;
  double factor = 1;  // in [0, 1)
};

// The tightenings of a single variable that make SUP < limit (INF > limit), each as mild as it can
// be to three digits; the mildest first. Empty if no single one does, or none is needed.
std::vector<Tightening> TighteningsToBringSupBelow(double limit, const Expression& e,
                                                   const ConstraintSet& constraints,
                                                   const BoundRequest& request);
std::vector<Tightening> TighteningsToBringInfAbove(double limit, const Expression& e,
                                                   const ConstraintSet& constraints,
                                                   const BoundRequest& request);

}  // namespace assay::algebra
