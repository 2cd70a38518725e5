#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "planner/plan/data/condition_kind.h"

namespace assay::constraint_posting {

using uncertainty::Unproved;

std::vector<Unproved> WithoutConditions(const std::vector<std::string>& absorbed,
                                        std::vector<Unproved> unproved) {
  std::erase_if(unproved, [&](const Unproved& unmet) {
    return std::ranges::count(absorbed, unmet.claim.condition) > 0;
  });
  return unproved;
}

bool DependsOnPlace(const Unproved& goal) {
  return !goal.neighbour.IsNone() || goal.claim.condition == "footprint";
}

std::vector<algebra::Expression> ExpressionsOf(const std::vector<Unproved>& goals) {
  std::vector<algebra::Expression> expressions;
  for (const Unproved& goal : goals) expressions.push_back(goal.expression);
  return expressions;
}

std::string WhyUnproved(const plan::CertifiedPrecondition& claim) {
  const bool less = claim.relation == plan::Relation::kLess;
  const plan::Quantity quantity = plan::QuantityOf(claim.condition);
  const bool is_angle = quantity == plan::Quantity::kAngle;
  const bool is_ratio = quantity == plan::Quantity::kRatio;
  const double scale = is_ratio ? 1 : is_angle ? 180 / std::numbers::pi : 1000;
  return fmt::format("not proved that {}: {} {:.4g}, must be {} {:.4g}{}", claim.meaning,
                     less ? "SUP" : "INF", scale * claim.bound, less ? "<" : ">",
                     scale * claim.limit,
                     is_ratio   ? ""
                     : is_angle ? " deg"
                                : " mm");
}

}  // namespace assay::constraint_posting
