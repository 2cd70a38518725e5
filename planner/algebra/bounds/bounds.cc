#include "planner/algebra/bounds/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/algebra/bounding_methods/centred.h"
#include "planner/algebra/bounding_methods/glance.h"
#include "planner/algebra/bounding_methods/monotone.h"
#include "planner/algebra/bounding_methods/termwise.h"
#include "planner/algebra/bounds/ascent.h"
#include "planner/algebra/bounds/branch_and_bound.h"
#include "planner/algebra/bounds/feasible_ascent.h"
#include "planner/algebra/multiaffine/multiaffine_form.h"
#include "planner/algebra/multiaffine/multiaffine_search.h"
#include "planner/algebra/normal_forms/normal_form.h"
#include "planner/algebra/normal_forms/normalization.h"
#include "planner/algebra/sup_inf/linear_part.h"
#include "planner/algebra/sup_inf/linear_program.h"
#include "planner/algebra/sup_inf/sup_inf.h"
#include "planner/base/check.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

// Bounds e (sign = 1) or -e (sign = -1) from above, by one bounding method after the other. A
// method can only lower the value, and every value is an upper bound by itself.
class Ladder {
 public:
  // `form` is the normal form of e, or null if it is not known.
  Ladder(const Expression& e, const NormalForm* form, int sign, const ConstraintSet& constraints,
         const BoundRequest& request)
      : e_(e), form_(form), sign_(sign), constraints_(constraints), request_(request) {
    stop_ = {.gap = request.gap, .evaluations = request.evaluations};
    if (request.limit) stop_.limit = sign * *request.limit;
    bound_.value = kInfinity;
  }

  Bound Climb() {
    if (!constraints_.inequalities.empty() || request_.highest == BoundingMethod::kLinear)
      StepOnLinear();
    if (!is_contradiction_ && !IsDone(BoundingMethod::kLinear)) ClimbOverBox();
    return Answer();
  }

 private:
  // Uses SUP/INF over the inequalities to bound the expression and to tighten the box.
  void StepOnLinear() {
    bound_.method = BoundingMethod::kLinear;
    const Expression sup = sign_ > 0 ? Sup(e_, {}, constraints_) : -Inf(e_, {}, constraints_);
    if (sup.IsConstant()) Lower(sup.constant(), BoundingMethod::kLinear);
    is_contradiction_ = Maximize(LinearForm(), LinearPartOf(constraints_).at_most_zero).kind ==
                        LinearOptimum::Kind::kContradiction;
    if (is_contradiction_) {
      bound_.value = -kInfinity;
    } else {
      constraints_.box = TightenedBox(constraints_);
    }
  }

  void ClimbOverBox() {
    const Maximization problem = form_ == nullptr ? MaximizationOf(e_, sign_, constraints_)
                                                  : MaximizationOf(e_, *form_, sign_, constraints_);
    Probe probe(problem);
    StepOnTermwise(probe);
    if (IsDone(BoundingMethod::kTermwise)) return;
    const Maximization reduced = StepOnMonotone(probe);
    if (IsDone(BoundingMethod::kMonotone)) return;
    Probe reduced_probe(reduced);
    StepOnCentred(reduced_probe);
    if (IsDone(BoundingMethod::kCentred)) return;
    StopRule stop = stop_;
    stop.evaluations -= bound_.evaluations - reduced_probe.evaluations();
    Lower(BranchAndBound(reduced_probe, bound_.value, stop), BoundingMethod::kBranchAndBound);
    Learn(reduced_probe);
    bound_.splits = reduced_probe.splits();
  }

  void StepOnTermwise(Probe& probe) {
    Lower(TermwiseRange(probe.problem().form, constraints_.box).high, BoundingMethod::kTermwise);
    ++bound_.evaluations;
    FindFirstPoint(probe);
    Learn(probe);
  }

  // Returns the smaller problem that remains after monotone variables are set to their best ends.
  Maximization StepOnMonotone(Probe& probe) {
    const Maximization& problem = probe.problem();
    const MonotoneBox monotone = SetMonotoneVariables(probe, problem.box, problem.constrained);
    const bool is_defined = probe.over_box().DefinedEverywhere();
    Lower(monotone.range.high, BoundingMethod::kMonotone);
    if (!problem.slacks.empty()) {
      Lower(SetMonotoneVariables(probe, monotone.box).range.high, BoundingMethod::kMonotone);
    } else {
      probe.Offer(AscendToCorner(probe, monotone.box));
    }
    Learn(probe);
    return is_defined ? Restricted(problem, monotone.box) : problem;
  }

  // The normal form writes the square of a sine as 1 - cos^2, so a small error becomes a difference
  // of large terms. The bound of the expression as it is written is usually looser than that of the
  // normal form, but not always. Both forms are therefore bounded.
  void StepOnCentred(Probe& probe) {
    const double as_it_stands = sign_ > 0 ? GlanceAbove(e_, constraints_.box, -kInfinity).bound
                                          : -GlanceBelow(e_, constraints_.box, kInfinity).bound;
    Lower(as_it_stands, BoundingMethod::kCentred);
    const MonotoneBox relaxed = SetMonotoneVariables(probe, probe.problem().box);
    const bool is_defined = probe.over_box().DefinedEverywhere();
    Lower(relaxed.range.high, BoundingMethod::kMonotone);
    FindPoint(probe);
    if (is_defined) {
      Lower(UpperBoundByDerivatives(probe, relaxed.box, relaxed.gradient),
            BoundingMethod::kCentred);
    }
    Learn(probe);
  }

  // Finds, with little work, a point that the first bounding methods can use.
  static void FindFirstPoint(Probe& probe) {
    const Maximization& problem = probe.problem();
    if (problem.slacks.empty()) {
      if (!probe.Offer(AscendToCorner(probe, problem.box))) probe.Offer(CentreOf(problem.box));
    } else {
      FindPoint(probe);
    }
  }

  static void FindPoint(Probe& probe) {
    const Maximization& problem = probe.problem();
    for (std::vector<double> start : {CentreOf(problem.box), AscendToCorner(probe, problem.box)}) {
      if (problem.slacks.empty()) {
        probe.Offer(AscendFrom(std::move(start), probe, problem.box));
        continue;
      }
      const std::vector<double> feasible = ApproachFeasible(std::move(start), probe);
      if (probe.SurelyFeasible(feasible)) probe.Offer(AscendFeasibly(feasible, probe));
    }
  }

  void Lower(double value, BoundingMethod method) {
    if (!(value < bound_.value)) return;  // is also true if the value is NaN
    bound_.value = value;
    bound_.method = method;
  }

  // Takes over the probe's best point and its count of evaluations.
  void Learn(const Probe& probe) {
    if (&probe.problem() != counted_) spent_before_ = bound_.evaluations;
    counted_ = &probe.problem();
    bound_.evaluations = spent_before_ + probe.evaluations();
    if (probe.has_best() && probe.best_value() > attained_) {
      attained_ = probe.best_value();
      bound_.at = FullPoint(probe.problem(), probe.best_point());
    }
  }

  bool IsDone(BoundingMethod method) const {
    return method >= request_.highest || stop_.IsMet(bound_.value, attained_);
  }

  Bound Answer() {
    const bool is_finite = std::isfinite(bound_.value) && std::isfinite(attained_);
    bound_.gap = is_finite ? std::max(0.0, RoundedUp(bound_.value - attained_)) : kInfinity;
    bound_.value *= sign_;
    return std::move(bound_);
  }

  const Expression& e_;
  const NormalForm* form_;
  int sign_;
  ConstraintSet constraints_;
  const BoundRequest& request_;
  StopRule stop_;
  Bound bound_;
  double attained_ = -kInfinity;
  bool is_contradiction_ = false;
  const Maximization* counted_ = nullptr;
  std::int64_t spent_before_ = 0;
};

}  // namespace

class PreparedExpression::Ready {
 public:
  explicit Ready(const Expression& e) : e_(e), form_(NormalFormOf(e)) {
    if (e.MayBeUndefined()) return;
    if (auto multiaffine = MultiaffineFormOf(form_)) search_.emplace(*std::move(multiaffine));
  }

  // Returns true if Search can answer questions over these constraints.
  bool Enter(const ConstraintSet& constraints, const BoundRequest& request) {
    const bool is_for_search =
        search_ && request.highest >= BoundingMethod::kMonotone && constraints.inequalities.empty();
    return is_for_search && search_->Enter(constraints.box);
  }

  // Answers a question after Enter has returned true. The search bounds its rounding errors
  // beforehand. If the search ends by itself and misses the gap, the bounds of these errors are too
  // large, and Climb may give a tighter bound.
  Bound Entered(int sign, const ConstraintSet& constraints, const BoundRequest& request) {
    Bound found = Search(sign, constraints, request);
    const bool is_done = found.gap <= request.gap || found.evaluations >= request.evaluations ||
                         request.limit.has_value();
    if (is_done) return found;
    Bound climbed = Climb(sign, constraints, request);
    climbed.evaluations += found.evaluations;
    return sign * climbed.value < sign * found.value ? climbed : found;
  }

  Bound Climb(int sign, const ConstraintSet& constraints, const BoundRequest& request) const {
    return Ladder(e_, &form_, sign, constraints, request).Climb();
  }

  Bound Bounded(int sign, const ConstraintSet& constraints, const BoundRequest& request) {
    return Enter(constraints, request) ? Entered(sign, constraints, request)
                                       : Climb(sign, constraints, request);
  }

 private:
  Bound Search(int sign, const ConstraintSet& constraints, const BoundRequest& request) {
    std::vector<double> middle;
    middle.reserve(constraints.box.size());
    for (const Interval& interval : constraints.box) middle.push_back(Midpoint(interval));
    return search_->Maximize(sign, request, std::move(middle));
  }

  Expression e_;
  NormalForm form_;
  std::optional<MultiaffineSearch> search_;
};

PreparedExpression::PreparedExpression(const Expression& e) : ready_(std::make_unique<Ready>(e)) {}
PreparedExpression::~PreparedExpression() = default;
PreparedExpression::PreparedExpression(PreparedExpression&&) noexcept = default;
PreparedExpression& PreparedExpression::operator=(PreparedExpression&&) noexcept = default;

Bound PreparedExpression::Above(const ConstraintSet& constraints, const BoundRequest& request) {
  return ready_->Bounded(1, constraints, request);
}

Bound PreparedExpression::Below(const ConstraintSet& constraints, const BoundRequest& request) {
  return ready_->Bounded(-1, constraints, request);
}

BothBounds PreparedExpression::Both(const ConstraintSet& constraints, const BoundRequest& request) {
  if (!ready_->Enter(constraints, request)) {
    return {ready_->Climb(-1, constraints, request), ready_->Climb(1, constraints, request)};
  }
  return {ready_->Entered(-1, constraints, request), ready_->Entered(1, constraints, request)};
}

namespace {

// Bounds an expression once. If the linear core comes first, the normal form is computed by Ladder,
// and only if it is needed.
Bound BoundOnce(const Expression& e, int sign, const ConstraintSet& constraints,
                const BoundRequest& request) {
  const bool starts_linear =
      !constraints.inequalities.empty() || request.highest == BoundingMethod::kLinear;
  if (starts_linear) return Ladder(e, nullptr, sign, constraints, request).Climb();
  PreparedExpression prepared(e);
  return sign > 0 ? prepared.Above(constraints, request) : prepared.Below(constraints, request);
}

}  // namespace

Bound BoundAbove(const Expression& e, const ConstraintSet& constraints,
                 const BoundRequest& request) {
  return BoundOnce(e, 1, constraints, request);
}

Bound BoundBelow(const Expression& e, const ConstraintSet& constraints,
                 const BoundRequest& request) {
  return BoundOnce(e, -1, constraints, request);
}

}  // namespace assay::algebra
