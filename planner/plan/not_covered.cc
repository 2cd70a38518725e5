#include "planner/plan/not_covered.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace assay::plan {
namespace {

constexpr char kServos[] = "oscillation of the servos while a part is carried";
constexpr char kTopples[] = "a part that topples, or is pushed into a neighbour, as the pads close";
constexpr char kSlides[] =
    "pads that slide along the part while it meets what it is put on or into";
constexpr char kPressed[] = "a part that is pressed over the edge of its support";
constexpr char kFixed[] = "a fixed part that the mating pushes aside or over";
constexpr char kOneFinger[] = "a finger that leaves the part later than the other";
constexpr char kPushes[] = "pads that slide, and an arm that does not follow, as a strategy pushes";

struct NotCoveredOf {
  const PlannedStep& step;

  std::vector<std::string> operator()(const Pickup&) const { return {kTopples, kServos}; }
  std::vector<std::string> operator()(const Putdown&) const {
    return {kSlides, kPressed, kOneFinger};
  }
  std::vector<std::string> operator()(const Assemble&) const {
    if (step.strategy) return {kPushes, kOneFinger};
    return {kSlides, kFixed, kOneFinger};
  }
  std::vector<std::string> operator()(const Sense&) const { return {}; }
  std::vector<std::string> operator()(const Squeeze&) const { return {kTopples, kOneFinger}; }
};

bool IsClaimed(const PlannedStep& step, std::string_view condition) {
  return std::ranges::count(step.certificate.preconditions, condition,
                            &CertifiedPrecondition::condition) > 0;
}

// What of the arm's ways could not be proved, or was never asked.
std::vector<std::string> WaysNotCovered(const Plan& plan) {
  std::vector<int> reach;
  std::vector<int> clear;
  for (const StepId id : plan.ExecutionOrder()) {
    const PlannedStep& step = plan.step(id);
    if (!IsClaimed(step, "reach")) reach.push_back(step.executed);
    if (!IsClaimed(step, "way clear")) clear.push_back(step.executed);
  }
  std::vector<std::string> names;
  if (!reach.empty()) {
    names.push_back(fmt::format(
        "an arm that errors lead to the end of a joint's range, or into another configuration "
        "than planned: steps {}",
        fmt::join(reach, ", ")));
  }
  if (!clear.empty()) {
    names.push_back(
        fmt::format("errors of the arm that lead it into something on its way: steps {}",
                    fmt::join(clear, ", ")));
  }
  return names;
}

}  // namespace

std::vector<std::string> NotCovered(const Plan& plan) {
  std::vector<std::string> all = WaysNotCovered(plan);
  for (const StepId id : plan.ExecutionOrder()) {
    const PlannedStep& step = plan.step(id);
    for (std::string& name : std::visit(NotCoveredOf{step}, step.action)) {
      if (std::ranges::count(all, name) == 0) all.push_back(std::move(name));
    }
  }
  return all;
}

}  // namespace assay::plan
