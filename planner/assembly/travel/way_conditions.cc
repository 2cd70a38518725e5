#include "planner/assembly/travel/way_conditions.h"

#include <numbers>
#include <string>
#include <utility>

#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/expression/text.h"
#include "planner/plan/data/condition_table.h"

namespace assay::assembly {
namespace {

// Returns the claim that a number, which already bounds the effect of the errors, is greater than
// 0.
plan::CertifiedPrecondition IsPositive(plan::Condition condition, std::string meaning,
                                       double least) {
  return {.condition = condition,
          .meaning = std::move(meaning),
          .expression = algebra::Text(algebra::Expression(least)),
          .relation = plan::Relation::kGreater,
          .limit = 0,
          .bound = least,
          .margin = least,
          .gap = 0,
          .method = std::string(algebra::Name(algebra::BoundingMethod::kLinear))};
}

constexpr char kOnTheWayHome[] = " on the way home";

}  // namespace

std::vector<plan::CertifiedPrecondition> WayConditions(const WayCertainty& certainty,
                                                       Whither whither) {
  const std::string on = whither == Whither::kHome ? kOnTheWayHome : "";
  std::vector<plan::CertifiedPrecondition> conditions;
  if (!certainty.Reaches()) return conditions;
  conditions.push_back(
      IsPositive(plan::condition::kReach,
                 "joints stay within their ranges and the arm in its configuration" + on,
                 certainty.sway.room));
  if (certainty.kept > 0) {
    conditions.push_back(IsPositive(plan::condition::kWayClear,
                                    "the arm and what it carries stay clear of everything" + on,
                                    certainty.kept));
  }
  return conditions;
}

bool IsWayCondition(plan::Condition condition) {
  return condition->needed_by == plan::NeededBy::kWay;
}

void RemoveWayConditions(plan::Certificate& certificate) {
  std::erase_if(certificate.preconditions,
                [](const auto& claim) { return IsWayCondition(claim.condition); });
  std::erase_if(certificate.not_needed,
                [](const auto& lacking) { return IsWayCondition(lacking.condition); });
}

Whither WhitherOf(const plan::CertifiedPrecondition& way_condition) {
  return way_condition.meaning.ends_with(kOnTheWayHome) ? Whither::kHome : Whither::kWork;
}

}  // namespace assay::assembly
