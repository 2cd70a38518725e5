#pragma once

#include <memory>

#include "planner/algebra/bounds/bound.h"
#include "planner/algebra/linear/constraint_set.h"

namespace assay::algebra {

// An expression made ready to be bounded again and again: what does not depend on the constraints
// (its normal form above all, which mostly takes longer than the search) is done once. Not to be
// shared between threads.
class PreparedExpression {
 public:
  explicit PreparedExpression(const Expression& e);
  ~PreparedExpression();
  PreparedExpression(PreparedExpression&&) noexcept;
  PreparedExpression& operator=(PreparedExpression&&) noexcept;

  Bound Above(const ConstraintSet& constraints, const BoundRequest& request);
  Bound Below(const ConstraintSet& constraints, const BoundRequest& request);
  // In less time than one after the other. A limit is of either.
  BothBounds Both(const ConstraintSet& constraints, const BoundRequest& request);

 private:
  class Ready;
  std::unique_ptr<Ready> ready_;
};

// SUP: bounds the expression from above over the constraints; BoundBelow: INF, from below.
Bound BoundAbove(const Expression& e, const ConstraintSet& constraints,
                 const BoundRequest& request);
Bound BoundBelow(const Expression& e, const ConstraintSet& constraints,
                 const BoundRequest& request);

}  // namespace assay::algebra
