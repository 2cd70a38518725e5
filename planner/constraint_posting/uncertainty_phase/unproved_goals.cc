#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"

#include <fmt/format.h>

#include <algorithm>

#include "planner/domain/units/units.h"

namespace assay::constraint_posting {

using uncertainty::Unproved;

std::vector<Unproved> WithoutConditions(const std::vector<plan::Condition>& absorbed,
                                        std::vector<Unproved> unproved) {
  std::erase_if(unproved, [&](const Unproved& unmet) {
    return std::ranges::count(absorbed, unmet.claim.condition) > 0;
  });
  return unproved;
}

bool DependsOnPlace(const Unproved& goal) {
  return !goal.neighbour.IsNone() ||
         goal.claim.condition->absorbed_by == plan::AbsorbedBy::kOtherPlace;
}

std::vector<algebra::Expression> ExpressionsOf(const std::vector<Unproved>& goals) {
  std::vector<algebra::Expression> expressions;
  for (const Unproved& goal : goals) expressions.push_back(goal.expression);
  return expressions;
}

std::string WhyUnproved(const plan::CertifiedPrecondition& claim) {
  if (claim.IsUnborne()) {
    return fmt::format("not proved that {}: at worst, nothing bears the load", claim.meaning);
  }
  const bool less = claim.relation == plan::Relation::kLess;
  const domain::Unit unit = domain::ShownUnitOf(claim.condition->dimension);
  const std::string limit = fmt::format("{:.4g}", claim.limit / unit.factor);
  return fmt::format("not proved that {}: {} {:.4g}, must be {} {}", claim.meaning,
                     less ? "SUP" : "INF", claim.bound / unit.factor, less ? "<" : ">",
                     domain::Beside(limit, unit));
}

}  // namespace assay::constraint_posting
