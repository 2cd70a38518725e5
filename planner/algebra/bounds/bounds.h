#pragma once

#include <memory>

#include "planner/algebra/bounds/bound.h"
#include "planner/algebra/sup_inf/constraint_set.h"

namespace assay::algebra {

// An expression prepared for being bounded repeatedly. Work that does not depend on the constraints
// is done once, above all the normal form, which mostly takes longer than the search. An object
// must not be shared between threads.
class PreparedExpression {
 public:
  explicit PreparedExpression(const Expression& e);
  ~PreparedExpression();
  PreparedExpression(PreparedExpression&&) noexcept;
  PreparedExpression& operator=(PreparedExpression&&) noexcept;

  Bound Above(const ConstraintSet& constraints, const BoundRequest& request);
  Bound Below(const ConstraintSet& constraints, const BoundRequest& request);
  // Returns both bounds in less time than two separate calls. The request's limit applies to each
  // of them.
  BothBounds Both(const ConstraintSet& constraints, const BoundRequest& request);

 private:
  class Ready;
  std::unique_ptr<Ready> ready_;
};

// BoundAbove returns SUP, a bound of e from above over the constraints. BoundBelow returns INF, a
// bound from below.
Bound BoundAbove(const Expression& e, const ConstraintSet& constraints,
                 const BoundRequest& request);
Bound BoundBelow(const Expression& e, const ConstraintSet& constraints,
                 const BoundRequest& request);

}  // namespace assay::algebra
