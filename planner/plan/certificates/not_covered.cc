#include "planner/plan/certificates/not_covered.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "planner/domain/problem/possible_starts.h"
#include "planner/plan/certificates/condition_table.h"

namespace assay::plan {
namespace {

constexpr char kServos[] =
    "motors that are too weak for the arm and the part, and oscillation of the servos, while a "
    "part "
    "is carried";
constexpr char kPushes[] = "pads that slip, and an arm that lags, under the pushes of a strategy";

constexpr char kBeside[] =
    "parts beside the two that are mated: during a strategy, the plan keeps clear of them only if "
    "there are no errors";

constexpr char kYields[] =
    "a wrist that yields: simulated arms have none, so a trial may stop at a rim over which it "
    "would lead the shaft";

// Returns whether the proof of a mating counts on a wrist that yields.
bool CountsOnYielding(const PlannedStep& step) {
  return std::ranges::any_of(step.certificate.preconditions, [](const auto& claim) {
    return claim.circumstance == Circumstance::kYieldingWrist;
  });
}

std::vector<std::string> NotCoveredOf(const PlannedStep& step) {
  const domain::ActionKind& kind = *step.action.kind;
  std::vector<std::string> names;
  if (kind.leaves == domain::Leaves::kInHand) names.emplace_back(kServos);
  if (kind.leaves != domain::Leaves::kMated) return names;
  if (step.strategy) return {kBeside, kPushes};
  if (CountsOnYielding(step)) return {kYields};
  return {};
}

// Returns the steps that do not claim the condition. The last step must claim it twice, the second
// time for the way home.
std::vector<int> StepsWithout(Condition condition, const Plan& plan) {
  std::vector<int> steps;
  for (const StepId id : plan.ExecutionOrder()) {
    const PlannedStep& step = plan.step(id);
    const bool is_last = step.executed == static_cast<int>(plan.steps.size());
    const auto claims = std::ranges::count(step.certificate.preconditions, condition,
                                           &CertifiedPrecondition::condition);
    if (claims < (is_last ? 2 : 1)) steps.push_back(step.executed);
  }
  return steps;
}

// Returns the arm's ways for which a condition could not be proved, or was not examined.
std::vector<std::string> WaysNotCovered(const Plan& plan) {
  std::vector<std::string> names;
  for (const ConditionKind* kind : KnownConditions()) {
    if (kind->left_open.empty()) continue;
    const std::vector<int> steps = StepsWithout(*kind, plan);
    if (steps.empty()) continue;
    names.push_back(fmt::format("{}: {} {}", kind->left_open, steps.size() == 1 ? "step" : "steps",
                                fmt::join(steps, ", ")));
  }
  return names;
}

std::vector<std::string> StartsNotCovered(const domain::Problem& problem) {
  std::vector<std::string> names;
  for (const auto& [a, b] : domain::PairsThatMayOverlap(problem)) {
    names.push_back(fmt::format(
        "errors with which {} and {} overlap at the start: no such start is possible, and no trial "
        "has one",
        problem.part(a).name, problem.part(b).name));
  }
  for (const domain::MatingId id : problem.assembled) {
    const domain::Mating& mating = problem.mating(id);
    names.push_back(fmt::format(
        "whether {} stays in {} as it is assembled at the start: only the balance of both together "
        "is examined",
        problem.part(mating.held).name, problem.part(mating.fixed).name));
  }
  return names;
}

// Friction that is nearly zero does not bring a released part to rest. It slides to and fro in its
// play for longer than a trial lasts (measured: friction of 0.001 in the engine).
std::vector<std::string> RestNotCovered(const domain::Problem& problem) {
  constexpr double kLeastFriction = 0.01;
  std::vector<std::string> names;
  for (const domain::Mating& mating : problem.matings) {
    const domain::Part& held = problem.part(mating.held);
    const domain::Part& fixed = problem.part(mating.fixed);
    const double least =
        std::max(held.model->friction(), fixed.model->friction()) - problem.tolerances.friction;
    if (least >= kLeastFriction) continue;
    names.push_back(fmt::format(
        "whether {} comes to rest in {}: their friction may be as little as {:.4g}, and below "
        "{} a released part may go on sliding in its play",
        held.name, fixed.name, std::max(0.0, least), kLeastFriction));
  }
  return names;
}

// Certificates assume that a part stops where a push ends. With little friction on the table it
// glides on for as long as its speed lasts (measured: 0.2 mm and 0.1 degrees at a friction of 0.01,
// and nothing at 0.1).
std::vector<std::string> GlidingNotCovered(const domain::Problem& problem, const Plan& plan) {
  constexpr double kLeastFriction = 0.1;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < problem.parts.size(); ++i) {
    const domain::Part& part = problem.parts[i];
    const double least = part.model->friction() - problem.tolerances.friction;
    const bool is_handled = std::ranges::any_of(plan.steps, [&](const PlannedStep& step) {
      return HoldIn(step.action) != nullptr && HandledPart(problem, step.action) == PartId(i);
    });
    if (!is_handled || least >= kLeastFriction) continue;
    names.push_back(fmt::format(
        "whether {} stops where the pads leave it: its friction may be as little as {:.4g}, and "
        "below {} a part may glide on over the table",
        part.name, std::max(0.0, least), kLeastFriction));
  }
  return names;
}

// A look needs more than bounded errors: the camera must see the part, and tell it from others.
std::vector<std::string> LooksNotCovered(const domain::Problem& problem, const Plan& plan) {
  std::vector<std::string> names;
  for (const StepId id : plan.ExecutionOrder()) {
    const Action& action = plan.step(id).action;
    if (action.sensor.empty()) continue;
    std::string name = fmt::format("whether {} finds {} where it is looked for", action.sensor,
                                   problem.part(action.part).name);
    if (std::ranges::count(names, name) == 0) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace

std::vector<int> StepsWithUnprovedWays(const Plan& plan) {
  std::set<int> unproved;
  bool is_claimed = false;
  for (const ConditionKind* kind : KnownConditions()) {
    if (kind->left_open.empty()) continue;
    const std::vector<int> steps = StepsWithout(*kind, plan);
    is_claimed |= steps.size() < plan.steps.size();
    unproved.insert(steps.begin(), steps.end());
  }
  if (!is_claimed) return {};
  return {unproved.begin(), unproved.end()};
}

std::vector<std::string> NotCovered(const domain::Problem& problem, const Plan& plan) {
  std::vector<std::string> all = StartsNotCovered(problem);
  std::ranges::move(RestNotCovered(problem), std::back_inserter(all));
  std::ranges::move(GlidingNotCovered(problem, plan), std::back_inserter(all));
  std::ranges::move(LooksNotCovered(problem, plan), std::back_inserter(all));
  std::ranges::move(WaysNotCovered(plan), std::back_inserter(all));
  for (const StepId id : plan.ExecutionOrder()) {
    const PlannedStep& step = plan.step(id);
    for (std::string& name : NotCoveredOf(step)) {
      if (std::ranges::count(all, name) == 0) all.push_back(std::move(name));
    }
  }
  return all;
}

}  // namespace assay::plan
