#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "planner/algebra/linear/constraint_set.h"

namespace assay::algebra {

// The bounding methods, from the cheapest to the tightest. Each is conservative, and each is tried
// only where the one before it left a gap.
enum class Rung {
  kLinear,    // SUP/INF's exact linear core: linear expressions over inequalities
  kTermwise,  // the paper's method: each product of the normal form is bounded alone
  kMonotone,  // each variable whose derivative has one sign is set to its best end
  kCentred,   // The value at a centre plus the range of the derivatives times the widths. For a
              // concave expression the derivatives at the centre suffice.
  kBranchAndBound,  // boxes are split until the gap is small enough
};
// Returns "linear", "termwise", "monotone", "centred" or "branch-and-bound".
std::string_view Name(Rung rung);

struct BoundRequest {
  Rung highest = Rung::kBranchAndBound;
  double gap = 1e-6;                   // the work ends when the bound is known to be this tight
  std::int64_t evaluations = 200'000;  // budget: evaluations over a box or at a point
  // The work also ends once the limit is decided. The bound may prove that the expression does not
  // reach the limit, or a feasible point may show that it does.
  std::optional<double> limit = {};
};

// A conservative bound and its quality. It holds at the points where the constraints hold and the
// expression has a real value. If there surely are no such points, SUP is -infinity and INF is
// +infinity.
struct Bound {
  double value = 0;             // never crossed by the expression; may be infinite
  Rung rung = Rung::kTermwise;  // the method that gave the value
  // An upper bound of the distance from `value` to the true extremum. It is the distance to the
  // value that the expression attains at `at`. It is infinite if `value` is, or if no point was
  // found.
  double gap = 0;
  std::vector<double> at = {};  // a feasible point, by VariableId; empty if none was found
  std::int64_t evaluations = 0;
  std::int64_t splits = 0;  // number of boxes that were split
};

struct BothBounds {
  Bound inf, sup;
};

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
