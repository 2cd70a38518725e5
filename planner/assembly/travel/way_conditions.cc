#include "planner/assembly/travel/way_conditions.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "planner/algebra/bounds/bounds.h"
#include "planner/algebra/expression/text.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/plan/certificates/coverage.h"

namespace assay::assembly {
namespace {

// Returns the claim that a number, which already bounds the effect of the errors, is greater than
// 0.
plan::CertifiedPrecondition IsPositive(plan::Condition condition, const std::string& meaning,
                                       plan::Circumstance circumstance, double least) {
  return {.condition = condition,
          .meaning = fmt::format("{}{}", meaning, plan::WordsOf(circumstance)),
          .expression = algebra::Text(algebra::Expression(least)),
          .relation = plan::Relation::kGreater,
          .limit = 0,
          .bound = least,
          .margin = least,
          .gap = 0,
          .method = std::string(algebra::Name(algebra::BoundingMethod::kLinear)),
          .worst = {},
          .circumstance = circumstance};
}

}  // namespace

std::vector<plan::CertifiedPrecondition> WayConditions(const WayCertainty& certainty,
                                                       plan::Circumstance circumstance) {
  std::vector<plan::CertifiedPrecondition> conditions;
  if (!certainty.Reaches()) return conditions;
  conditions.push_back(IsPositive(
      plan::condition::kReach, "joints stay within their ranges and the arm in its configuration",
      circumstance, certainty.sway.room));
  if (certainty.kept > 0) {
    conditions.push_back(IsPositive(plan::condition::kWayClear,
                                    "the arm and what it carries stay clear of everything",
                                    circumstance, certainty.kept));
  }
  return conditions;
}

bool IsWayCondition(plan::Condition condition) {
  return condition->needed_by == plan::NeededBy::kWay;
}

bool HasSoundCertificates(const plan::Plan& plan) {
  return !plan::IsAsPublished(plan) &&
         std::ranges::any_of(plan.steps, [](const plan::PlannedStep& step) {
           return step.certificate != plan::Certificate{};
         });
}

bool ClaimsWays(const plan::Plan& plan) {
  return std::ranges::any_of(plan.steps, [](const plan::PlannedStep& step) {
    return std::ranges::any_of(step.certificate.preconditions,
                               [](const auto& claim) { return IsWayCondition(claim.condition); });
  });
}

void RemoveWayConditions(plan::Certificate& certificate) {
  std::erase_if(certificate.preconditions,
                [](const auto& claim) { return IsWayCondition(claim.condition); });
  std::erase_if(certificate.not_needed,
                [](const auto& lacking) { return IsWayCondition(lacking.condition); });
}

}  // namespace assay::assembly
