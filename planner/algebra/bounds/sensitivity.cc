#include "planner/algebra/bounds/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "planner/algebra/expression/nodes.h"
#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

constexpr int kFactorSteps = 1000;  // factors are found to three digits

Interval Shrunk(const Interval& interval, double factor) {
  const double middle = Midpoint(interval);
  if (factor == 0) return {middle, middle};
  return {middle - factor * (middle - interval.low), middle + factor * (interval.high - middle)};
}

Bound SupWithShrunk(VariableId variable, double factor, PreparedExpression& e,
                    ConstraintSet constraints, const BoundRequest& request) {
  Interval& interval = constraints.box[variable.index()];
  interval = Shrunk(interval, factor);
  return e.Above(constraints, request);
}

// Returns the variables of e whose intervals have a width.
std::vector<VariableId> UncertainVariables(const Expression& e, const ConstraintSet& constraints) {
  std::vector<VariableId> uncertain;
  for (VariableId variable : VariablesOf(e)) {
    const Interval& interval = constraints.box[variable.index()];
    if (interval.low < interval.high) uncertain.push_back(variable);
  }
  return uncertain;
}

// Returns the greatest difference of two bounds whose true extrema are the same.
double Noise(const Bound& a, const Bound& b, const BoundRequest& request) {
  return std::min(a.gap + b.gap, request.gap);
}

// Returns the greatest factor that brings SUP below the limit, if there is one. Every smaller
// factor does so, too.
std::optional<Tightening> MildestTightening(VariableId variable, double limit,
                                            PreparedExpression& e, const ConstraintSet& constraints,
                                            const BoundRequest& request) {
  const auto suffices = [&](int step) {
    const double factor = static_cast<double>(step) / kFactorSteps;
    return SupWithShrunk(variable, factor, e, constraints, request).value < limit;
  };
  if (!suffices(0)) return std::nullopt;
  int enough = 0;
  for (int too_mild = kFactorSteps; too_mild - enough > 1;) {
    const int middle = (enough + too_mild) / 2;
    (suffices(middle) ? enough : too_mild) = middle;
  }
  return Tightening{variable, static_cast<double>(enough) / kFactorSteps};
}

}  // namespace

std::vector<Share> SharesOfSup(const Expression& e, const ConstraintSet& constraints,
                               const BoundRequest& request) {
  BoundRequest exact = request;
  exact.limit.reset();
  PreparedExpression prepared(e);
  const Bound all = prepared.Above(constraints, exact);
  std::vector<Share> shares;
  for (VariableId variable : UncertainVariables(e, constraints)) {
    const Bound without = SupWithShrunk(variable, 0, prepared, constraints, exact);
    const double cost = all.value - without.value;
    // With -infinity, no point at this midpoint satisfies the inequalities, so the cost is unknown.
    if (std::isfinite(without.value) && cost > Noise(all, without, exact)) {
      shares.push_back({variable, cost});
    }
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const Share& a, const Share& b) { return a.cost > b.cost; });
  return shares;
}

std::vector<Share> SharesOfInf(const Expression& e, const ConstraintSet& constraints,
                               const BoundRequest& request) {
  return SharesOfSup(-e, constraints, request);
}

std::vector<Tightening> TighteningsToBringSupBelow(double limit, const Expression& e,
                                                   const ConstraintSet& constraints,
                                                   const BoundRequest& request) {
  BoundRequest question = request;
  question.limit = limit;
  std::vector<Tightening> tightenings;
  PreparedExpression prepared(e);
  if (prepared.Above(constraints, question).value < limit) return tightenings;
  for (VariableId variable : UncertainVariables(e, constraints)) {
    const auto mildest = MildestTightening(variable, limit, prepared, constraints, question);
    if (mildest) tightenings.push_back(*mildest);
  }
  std::stable_sort(tightenings.begin(), tightenings.end(),
                   [](const Tightening& a, const Tightening& b) { return a.factor > b.factor; });
  return tightenings;
}

std::vector<Tightening> TighteningsToBringInfAbove(double limit, const Expression& e,
                                                   const ConstraintSet& constraints,
                                                   const BoundRequest& request) {
  return TighteningsToBringSupBelow(-limit, -e, constraints, request);
}

}  // namespace assay::algebra
