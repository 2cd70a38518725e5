#include "planner/budget/obstacle.h"

#include "planner/assembly/certified_plan.h"
#include "planner/assembly/plan_check.h"
#include "planner/assembly/travel/unproved_ways.h"
#include "planner/base/input_files/input_error.h"
#include "planner/uncertainty/preconditions/certify.h"

namespace assay::budget {
namespace {

// Returns the first unproved precondition of certificates that are computed anew.
std::optional<Obstacle> InCertificates(const domain::Problem& problem, const plan::Plan& plan) {
  uncertainty::UncertainWorld world(problem, uncertainty::Propagation::kSound);
  for (const plan::StepId id : plan.ExecutionOrder()) {
    const plan::PlannedStep& step = plan.step(id);
    const auto certified =
        uncertainty::CertifyStep(world, step.action, {}, step.strategy ? &*step.strategy : nullptr);
    for (const uncertainty::Unproved& unproved : certified.unproved) {
      if (!plan::Absorbs(step.strategy, unproved.claim.condition))
        return Obstacle{step.name, unproved.claim.meaning};
    }
  }
  return std::nullopt;
}

std::optional<Obstacle> InStrategies(const domain::Problem& problem, const plan::Plan& plan) {
  const std::vector<plan::Flaw> flaws = assembly::FlawsOfStrategies(problem, plan);
  if (flaws.empty()) return std::nullopt;
  return Obstacle{plan.step(flaws.front().step).name, flaws.front().what};
}

std::optional<Obstacle> InWays(const domain::Problem& problem, const plan::Plan& plan) {
  const std::vector<assembly::UnprovedWay> ways = assembly::UnprovedWays(problem, plan);
  if (ways.empty()) return std::nullopt;
  const assembly::UnprovedWay& way = ways.front();
  return Obstacle{way.step.IsNone() ? "home" : plan.step(way.step).name, way.why.text};
}

}  // namespace

std::optional<Obstacle> ObstacleOfPlan(const domain::Problem& problem, const plan::Plan& plan) {
  try {
    for (const auto& in : {InCertificates, InStrategies, InWays}) {
      if (std::optional<Obstacle> obstacle = in(problem, plan)) return obstacle;
    }
    return std::nullopt;
  } catch (const InputError& error) {  // parts that cannot have such a clearance
    return Obstacle{"", error.what()};
  }
}

PlannedAnew PlanAnew(const domain::Problem& problem) {
  try {
    PlannedAnew planned = {assembly::MakeCertifiedPlan(problem, {}, {}), std::nullopt};
    if (planned.result.outcome != Outcome::kFound) {
      planned.obstacle = Obstacle{"", "no plan is found"};
    } else {
      planned.obstacle = ObstacleOfPlan(problem, planned.result.plan);
    }
    return planned;
  } catch (const InputError& error) {
    return {{}, Obstacle{"", error.what()}};
  }
}

}  // namespace assay::budget
