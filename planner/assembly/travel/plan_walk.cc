#include "planner/assembly/travel/plan_walk.h"

#include <utility>

#include "planner/assembly/travel/work_lines.h"
#include "planner/motion/collision/collision_scene.h"
#include "planner/uncertainty/error_sets/tool_error_box.h"
#include "planner/uncertainty/preconditions/certify.h"

namespace assay::assembly {
namespace {

using domain::PartId;
using plan::StepId;

// Returns the part whose believed pose guides the hand, or None if the hand goes to the planned
// pose.
PartId GuideOf(const domain::Problem& problem, const plan::Action& action) {
  const bool is_guided =
      plan::HoldIn(action) != nullptr && action.kind->leaves != domain::Leaves::kAtPlace;
  return is_guided ? plan::PlacedPart(problem, action) : PartId::None();
}

// Returns the parts that the action handles or mates. A look at a part is not work on it.
std::vector<PartId> PartsAtHand(const domain::Problem& problem, const plan::Action& action) {
  return plan::HoldIn(action) != nullptr ? plan::PartsOf(problem, action) : std::vector<PartId>{};
}

}  // namespace

PlanWalk::PlanWalk(const domain::Problem& problem, const plan::Plan& plan,
                   uncertainty::Propagation propagation)
    : problem_(problem),
      plan_(plan),
      state_(plan::InitialState(problem)),
      world_(problem, propagation),
      doubts_(problem),
      arm_(motion::ArmBodies(problem.workcell->arm())),
      left_(plan::HomeTool(*problem.workcell)) {
  doubt_left_ = uncertainty::ToolErrorBoxAt(world_, PartId::None(), left_);
}

plan::ToolRoute PlanWalk::RouteTo(StepId id) const {
  if (id.IsNone()) return {.poised = plan::HomeTool(workcell())};
  const plan::Action& action = plan_.step(id).action;
  return plan::RouteOf(problem_, plan_.step(id),
                       state_.part(plan::PlacedPart(problem_, action)).X_WorldPart);
}

// The route consists of straight lines. So a rotation of the believed pose shifts no point of the
// route farther than one of its ends.
plan::ToolErrorBox PlanWalk::DoubtOn(StepId id) const {
  const plan::ToolRoute route = RouteTo(id);
  const PartId guide = id.IsNone() ? PartId::None() : GuideOf(problem_, plan_.step(id).action);
  plan::ToolErrorBox doubt = uncertainty::ToolErrorBoxAt(world_, guide, route.poised);
  for (const auto* poses : {&route.to_work, &route.away}) {
    for (const plan::Pose& pose : *poses) {
      doubt = doubt.Or(uncertainty::ToolErrorBoxAt(world_, guide, pose));
    }
  }
  return doubt;
}

std::vector<PartId> PlanWalk::PartsAtWork(StepId id) const {
  std::vector<PartId> parts = parts_left_;
  if (!id.IsNone()) {
    const std::vector<PartId> next = PartsAtHand(problem_, plan_.step(id).action);
    parts.insert(parts.end(), next.begin(), next.end());
  }
  std::erase(parts, state_.in_hand);
  return parts;
}

bool PlanWalk::IsGuarded(StepId id) const {
  if (id.IsNone()) return false;
  const plan::PlannedStep& step = plan_.step(id);
  return assembly::IsGuarded(step.action) && !step.strategy;
}

std::vector<StepId> PlanWalk::Steps() const {
  std::vector<StepId> steps = plan_.ExecutionOrder();
  if (!steps.empty()) steps.push_back(StepId::None());
  return steps;
}

void PlanWalk::ComeTo(StepId id) {
  if (!id.IsNone()) doubts_.Take(plan_.step(id).certificate.before);
  TakeRestingDoubts();
}

// Certificates give errors relative to the believed poses of parts at that time. The errors here
// are relative to the planned poses.
void PlanWalk::TakeRestingDoubts() {
  std::vector<plan::ErrorSet> about_plan;
  for (std::size_t p = 0; p < problem_.parts.size(); ++p) {
    const PartId part(p);
    if (part == state_.in_hand) continue;
    const uncertainty::RestingError error = world_.about_plan(part);
    about_plan.push_back({.part = part,
                          .x = world_.RangeOf(error.displacement[0]),
                          .y = world_.RangeOf(error.displacement[1]),
                          .z = world_.RangeOf(error.displacement[2]),
                          .theta = world_.RangeOf(error.theta)});
  }
  doubts_.Take(about_plan);
}

motion::Surroundings PlanWalk::Surroundings() const {
  motion::Surroundings surroundings{.errors = doubts_.In(state_),
                                    .opening = workcell().gripper().max_opening()};
  for (std::size_t p = 0; p < state_.parts.size(); ++p) {
    if (PartId(p) == state_.in_hand) continue;
    surroundings.parts.push_back({PartId(p), state_.parts[p].X_WorldPart});
  }
  if (!state_.in_hand.IsNone()) {
    surroundings.held = motion::HeldPart{state_.in_hand, state_.hold.X_PartTool};
    surroundings.opening = state_.hold.width;
  }
  return surroundings;
}

void PlanWalk::Do(StepId id) {
  const plan::PlannedStep& step = plan_.step(id);
  const plan::ToolRoute route = RouteTo(id);
  doubt_left_ = DoubtOn(id);
  left_ = route.left();
  rises_ = !route.away.empty();
  parts_left_ = PartsAtHand(problem_, step.action);
  state_ = plan::StateAfter(problem_, std::move(state_), step.action, id);
  uncertainty::Propagate(world_, step.action, step.strategy ? &*step.strategy : nullptr);
  doubts_.Take(step.certificate.after);
}

}  // namespace assay::assembly
