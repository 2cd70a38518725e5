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

void AddOfStrategies(const domain::Problem& problem, const plan::Plan& plan,
                     std::vector<Obstacle>& obstacles) {
  for (const plan::Flaw& flaw : assembly::FlawsOfStrategies(problem, plan))
    obstacles.push_back({plan.step(flaw.step).name, flaw.what});
}

void AddOfWays(const domain::Problem& problem, const plan::Plan& plan,
               std::vector<Obstacle>& obstacles) {
  for (const assembly::UnprovedWay& way : assembly::UnprovedWays(problem, plan))
    obstacles.push_back({way.step.IsNone() ? "home" : plan.step(way.step).name, way.why.text});
}

}  // namespace

std::vector<Obstacle> ObstaclesBesideCertificates(const domain::Problem& problem,
                                                  const plan::Plan& plan) {
  std::vector<Obstacle> obstacles;
  AddOfStrategies(problem, plan, obstacles);
  AddOfWays(problem, plan, obstacles);
  return obstacles;
}

std::optional<Obstacle> ObstacleOfPlan(const domain::Problem& problem, const plan::Plan& plan) {
  try {
    if (std::optional<Obstacle> obstacle = InCertificates(problem, plan)) return obstacle;
    const std::vector<Obstacle> others = ObstaclesBesideCertificates(problem, plan);
    if (others.empty()) return std::nullopt;
    return others.front();
  } catch (const InputError& error) {  // parts that cannot have such a clearance
    return Obstacle{"", error.what()};
  }
}

PlannedAnew PlanAnew(const domain::Problem& problem) {
  try {
    PlannedAnew planned = {assembly::MakeCertifiedPlan(problem, {}, {}), {}};
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
