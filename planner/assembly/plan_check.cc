#include "planner/assembly/plan_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <variant>

#include "planner/assembly/travel/travel_check.h"
#include "planner/domain/matings/mating_classes.h"
#include "planner/finemotion/strategy_checks/strategy_check.h"

namespace assay::assembly {
namespace {

constexpr double kRoundedFriction = 1e-6;  // share by which a file may round friction

std::vector<std::string> FlawsOfStrategy(const domain::Problem& problem,
                                         const domain::Mating& mating,
                                         const plan::Strategy& strategy) {
  std::vector<std::string> flaws =
      finemotion::FlawsOfStrategy(finemotion::GeometryOf(problem, mating), strategy);
  for (const plan::Condition condition : strategy.certificate.absorbs) {
    if (condition->absorbed_by == plan::AbsorbedBy::kFineMotion) continue;
    flaws.push_back(fmt::format("no strategy absorbs '{}'", condition.name()));
  }
  const double velocity = problem.mating_errors.velocity;
  if (strategy.certificate.velocity < velocity) {
    flaws.push_back(
        fmt::format("it is certain for directions that err by {:.4g}, and they may by {:.4g}",
                    strategy.certificate.velocity, velocity));
  }
  const double friction = domain::GreatestMatingFriction(problem, mating);
  if (strategy.friction < (1 - kRoundedFriction) * friction) {
    flaws.push_back(fmt::format("it counts on friction of at most {:.4g}, and there may be {:.4g}",
                                strategy.friction, friction));
  }
  return flaws;
}

}  // namespace

plan::CheckReport Check(const domain::Problem& problem, const plan::Plan& plan,
                        int most_linearizations) {
  plan::CheckReport report = plan::Check(problem, plan, most_linearizations);
  std::ranges::move(FlawsOfStrategies(problem, plan), std::back_inserter(report.flaws));
  if (report.flaws.empty()) report.flaws = FlawsOfTravels(problem, plan);
  return report;
}

std::vector<plan::Flaw> FlawsOfStrategies(const domain::Problem& problem, const plan::Plan& plan) {
  std::vector<plan::Flaw> flaws;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const plan::PlannedStep& step = plan.steps[i];
    const domain::MatingId mating = step.action.mating;
    if (!step.strategy || !plan::FlawsOfForm(*step.strategy).empty()) continue;
    if (mating.IsNone() || mating.index() >= std::ssize(problem.matings)) continue;
    for (std::string& what : FlawsOfStrategy(problem, problem.mating(mating), *step.strategy)) {
      flaws.push_back({plan::StepId(i), "the strategy: " + std::move(what)});
    }
  }
  return flaws;
}

}  // namespace assay::assembly
