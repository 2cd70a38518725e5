#include "planner/plan/data/tool_route.h"

#include <algorithm>

#include "planner/geometry/pose.h"

namespace assay::plan {
namespace {

using domain::Workcell;
using geometry::Translation;
using geometry::Vector3;

Pose Lifted(const Workcell& workcell, const Pose& X_WorldTool) {
  return Translation(0, 0, workcell.rules().approach_distance) * X_WorldTool;
}

// The line is along the mating vector, from the distance at which a straight mating would begin.
ToolRoute RouteByStrategy(const domain::Problem& problem, const Action& action,
                          const Strategy& strategy, const Pose& X_WorldFixed) {
  const domain::Mating& mating = problem.mating(action.mating);
  const Pose mated = X_WorldFixed * mating.X_FixedHeld * action.hold.X_PartTool;
  const Pose start =
      X_WorldFixed * strategy.X_FixedStart * strategy.X_HeldTip.inverse() * action.hold.X_PartTool;
  const Vector3 direction = mating.mating_vector.normalized();
  const Vector3 way =
      mating.X_FixedHeld * strategy.X_HeldTip.translation() - strategy.X_FixedStart.translation();
  const double before = std::max(0.0, mating.mating_vector.norm() - way.dot(direction));
  return {.poised = Translation(-before * (X_WorldFixed.linear() * direction)) * start,
          .to_work = {start},
          .away = {Retreated(*problem.workcell, mated)}};
}

ToolRoute RouteOfMating(const domain::Problem& problem, const Action& action,
                        const Pose& X_WorldFixed) {
  const domain::Mating& mating = problem.mating(action.mating);
  const Pose mated = X_WorldFixed * mating.X_FixedHeld * action.hold.X_PartTool;
  return {.poised = Translation(-(X_WorldFixed.linear() * mating.mating_vector)) * mated,
          .to_work = {mated},
          .away = {Retreated(*problem.workcell, mated)}};
}

// A hand that holds the part goes straight up and down; an empty hand follows the tool's axis.
ToolRoute RouteOfHand(const Workcell& workcell, const Action& action, const Pose& X_WorldTool) {
  const bool holds_before = action.kind->Needs(domain::Need::kHolding);
  const bool holds_after = action.kind->leaves == domain::Leaves::kInHand;
  const auto apart = [&](bool holds) {
    return holds ? Lifted(workcell, X_WorldTool) : Retreated(workcell, X_WorldTool);
  };
  return {.poised = apart(holds_before), .to_work = {X_WorldTool}, .away = {apart(holds_after)}};
}

}  // namespace

Pose Retreated(const Workcell& workcell, const Pose& X_WorldTool) {
  return X_WorldTool * Translation(0, 0, -workcell.rules().approach_distance);
}

ToolRoute RouteOf(const domain::Problem& problem, const PlannedStep& step,
                  const Pose& X_WorldPart) {
  return RouteOf(problem, step.action, step.strategy ? &*step.strategy : nullptr, X_WorldPart);
}

ToolRoute RouteOf(const domain::Problem& problem, const Action& action, const Strategy* strategy,
                  const Pose& X_WorldPart) {
  if (HoldIn(action) == nullptr) return {.poised = HomeTool(*problem.workcell)};
  switch (action.kind->leaves) {
    case domain::Leaves::kMated:
      return strategy != nullptr ? RouteByStrategy(problem, action, *strategy, X_WorldPart)
                                 : RouteOfMating(problem, action, X_WorldPart);
    case domain::Leaves::kAtPlace:
      return RouteOfHand(*problem.workcell, action,
                         action.place.X_WorldPart * action.hold.X_PartTool);
    case domain::Leaves::kInHand:
    case domain::Leaves::kWhereItWas:
      break;
  }
  return RouteOfHand(*problem.workcell, action, X_WorldPart * action.hold.X_PartTool);
}

Pose HomeTool(const Workcell& workcell) {
  return workcell.X_WorldBase() * workcell.arm().Forward(workcell.home()) *
         workcell.gripper().X_FlangeTool();
}

Pose AtSafeHeight(const Workcell& workcell, const Pose& X_WorldTool) {
  Pose raised = X_WorldTool;
  raised.translation().z() = std::max(raised.translation().z(), workcell.rules().safe_height);
  return raised;
}

}  // namespace assay::plan
