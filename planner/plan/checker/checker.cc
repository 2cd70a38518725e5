#include "planner/plan/checker/checker.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "planner/plan/certificates/coverage.h"
#include "planner/plan/certificates/not_covered.h"
#include "planner/plan/checker/action_check.h"
#include "planner/plan/checker/goal_check.h"
#include "planner/plan/checker/label_check.h"
#include "planner/plan/checker/linearization.h"
#include "planner/plan/checker/world_state.h"

namespace assay::plan {
namespace {

using Order = std::vector<StepId>;

template <class Tag, class T>
bool IsIndexOf(Id<Tag> id, const std::vector<T>& things) {
  return id.index() >= 0 && id.index() < static_cast<int>(things.size());
}

// Returns whether the action only names a part or a mating that the problem has.
bool SpeaksOf(const domain::Problem& problem, const Action& action) {
  return action.kind->Has(domain::Argument::kMating) ? IsIndexOf(action.mating, problem.matings)
                                                     : IsIndexOf(action.part, problem.parts);
}

// Returns the flaws of strategies: forms that the executor cannot follow, and strategies that do
// not fit their steps.
std::vector<Flaw> FlawsOfStrategies(const Plan& plan) {
  std::vector<Flaw> flaws;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const PlannedStep& step = plan.steps[i];
    if (!step.strategy) continue;
    if (step.action.kind->leaves != domain::Leaves::kMated) {
      flaws.push_back({StepId(i), "it has a strategy, which only assemble can have"});
    }
    for (std::string& what : FlawsOfForm(*step.strategy)) {
      flaws.push_back({StepId(i), "the strategy: " + std::move(what)});
    }
  }
  return flaws;
}

// Returns the flaws that make a plan unusable, so no order of it can be simulated.
std::vector<Flaw> FlawsOfPlanForm(const domain::Problem& problem, const Plan& plan) {
  std::vector<Flaw> flaws;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (SpeaksOf(problem, plan.steps[i].action)) continue;
    flaws.push_back({StepId(i), "the step names a part or mating that the problem does not have"});
  }
  const Order order = plan.ExecutionOrder();
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int executed = plan.step(order[i]).executed;
    if (executed == static_cast<int>(i) + 1) continue;
    flaws.push_back(
        {order[i], fmt::format("executed as number {}, where {} should be", executed, i + 1)});
  }
  const auto is_step = [&](StepId id) { return IsIndexOf(id, plan.steps); };
  for (const auto& [first, second] : plan.ordering) {
    if (is_step(first) && is_step(second)) continue;
    flaws.push_back({StepId::None(), "the ordering speaks of a step that the plan has not"});
    return flaws;
  }
  if (!IsAcyclic(static_cast<int>(plan.steps.size()), plan.ordering)) {
    flaws.push_back({StepId::None(), "the ordering is cyclic"});
  }
  return flaws;
}

// Simulates orders of a plan. A step is examined once in each state of the world that it meets.
class Simulation {
 public:
  Simulation(const domain::Problem& problem, const Plan& plan)
      : problem_(problem), plan_(plan), checker_(problem) {}

  void GoThrough(const Order& order) {
    WorldState state = InitialState(problem_);
    for (StepId step : order) {
      const Action& action = plan_.step(step).action;
      if (seen_.insert(SituationOf(step, state)).second) Examine(state, step, order);
      state = StateAfter(problem_, std::move(state), action, step);
    }
    if (!seen_.insert(SituationOf(StepId::None(), state)).second) return;
    for (const std::string& what : GoalsNotReached(problem_, state)) {
      Report({StepId::None(), what}, order);
    }
  }

  std::vector<Flaw> TakeFlaws() { return std::move(flaws_); }

 private:
  // A step and the state before it. The state is given by the step that last moved each part: this
  // step determines the place, the hold and the mating of the part.
  using Situation = std::vector<StepId>;

  static Situation SituationOf(StepId step, const WorldState& state) {
    Situation situation = {
        step, state.in_hand.IsNone() ? StepId::None() : state.part(state.in_hand).moved_by};
    for (const PartState& part : state.parts) situation.push_back(part.moved_by);
    return situation;
  }

  void Examine(const WorldState& before, StepId step, const Order& order) {
    const Action& action = plan_.step(step).action;
    for (const auto& findings : {BrokenPreconditions(problem_, before, action),
                                 checker_.BrokenConditions(before, action)}) {
      for (const std::string& what : findings) Report({step, what}, order);
    }
  }

  // A flaw that several orders have is reported for the first of them. The order of execution goes
  // first, and is not named.
  void Report(Flaw flaw, const Order& order) {
    if (!reported_.emplace(flaw.step, flaw.what).second) return;
    if (order != plan_.ExecutionOrder()) {
      std::vector<std::string> names;
      for (StepId step : order) names.push_back(plan_.step(step).name);
      flaw.what += fmt::format(" (in the order {})", fmt::join(names, ", "));
    }
    flaws_.push_back(std::move(flaw));
  }

  const domain::Problem& problem_;
  const Plan& plan_;
  ActionChecker checker_;
  std::set<Situation> seen_;
  std::set<std::pair<StepId, std::string>> reported_;
  std::vector<Flaw> flaws_;
};

// Adds a flaw for each text that occurs more often in `more` than in `less`.
void AddSurplus(const std::vector<std::string>& more, const std::vector<std::string>& less,
                std::string_view says, std::vector<Flaw>& flaws) {
  for (const std::string& text : std::set(more.begin(), more.end())) {
    if (std::ranges::count(more, text) <= std::ranges::count(less, text)) continue;
    flaws.push_back({StepId::None(), fmt::format("not_covered {} '{}'", says, text)});
  }
}

// Returns the differences between the plan's list of effects that no precondition covers and the
// true list.
std::vector<Flaw> FlawsOfNotCovered(const domain::Problem& problem, const Plan& plan) {
  std::vector<Flaw> flaws;
  if (!plan.not_covered) return flaws;
  const std::vector<std::string> anew = NotCovered(problem, plan);
  AddSurplus(anew, *plan.not_covered, "does not name", flaws);
  AddSurplus(*plan.not_covered, anew, "names without reason", flaws);
  return flaws;
}

}  // namespace

std::vector<Flaw> FlawsOfCoverage(const domain::Problem& problem, const Plan& plan) {
  std::vector<Flaw> flaws = FlawsOfNotCovered(problem, plan);
  if (!IsCertified(plan)) return flaws;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    for (std::string& what : FlawsOfCoverage(plan.steps[i])) {
      flaws.push_back({StepId(i), std::move(what)});
    }
  }
  return flaws;
}

CheckReport Check(const domain::Problem& problem, const Plan& plan, int most_linearizations) {
  CheckReport report{.flaws = FlawsOfPlanForm(problem, plan)};
  if (!report.flaws.empty()) return report;

  const Order execution = plan.ExecutionOrder();
  Simulation simulation(problem, plan);
  simulation.GoThrough(execution);
  report.linearizations = 1;
  report.all_orders = VisitLinearizations(static_cast<int>(plan.steps.size()), plan.ordering,
                                          [&](const Order& order) {
                                            if (order == execution) return Visit::kContinue;
                                            if (report.linearizations >= most_linearizations)
                                              return Visit::kStop;
                                            simulation.GoThrough(order);
                                            ++report.linearizations;
                                            return Visit::kContinue;
                                          });
  report.flaws = simulation.TakeFlaws();
  std::ranges::move(FlawsOfStrategies(plan), std::back_inserter(report.flaws));
  std::ranges::move(FlawsOfCoverage(problem, plan), std::back_inserter(report.flaws));
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    for (std::string& label : MisleadingLabels(problem, plan.steps[i].action)) {
      report.flaws.push_back({StepId(i), std::move(label)});
    }
  }

  const auto [first, second] = FirstBroken(plan.ordering, execution);
  if (!first.IsNone()) {
    report.flaws.push_back({second, fmt::format("executed before {}, which the ordering puts first",
                                                plan.step(first).name)});
  }
  return report;
}

}  // namespace assay::plan
