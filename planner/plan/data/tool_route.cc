#include "planner/plan/data/tool_route.h"

#include <algorithm>

namespace assay::plan {
namespace {

using domain::Workcell;
using geometry::Translation;
using geometry::Vector3;

Pose Lifted(const Workcell& workcell, const Pose& X_WorldTool) {
  return Translation(0, 0, workcell.rules().approach_distance) * X_WorldTool;
}

struct RouteOfAction {
  const domain::Problem& problem;
  const Pose& X_WorldPart;
  const std::optional<Strategy>& strategy;

  ToolRoute operator()(const Pickup& pickup) const { return RouteOf(problem, pickup, X_WorldPart); }
  ToolRoute operator()(const Putdown& putdown) const { return RouteOf(problem, putdown); }
  ToolRoute operator()(const Assemble& assemble) const {
    return strategy ? RouteOf(problem, assemble, *strategy, X_WorldPart)
                    : RouteOf(problem, assemble, X_WorldPart);
  }
  ToolRoute operator()(const Sense&) const { return {.poised = HomeTool(*problem.workcell)}; }
  ToolRoute operator()(const Squeeze& squeeze) const {
    return RouteOf(problem, squeeze, X_WorldPart);
  }
};

struct PartOfAction {
  const domain::Problem& problem;

  PartId operator()(const Assemble& assemble) const {
    return problem.mating(assemble.mating).fixed;
  }
  PartId operator()(const auto& action) const { return action.part; }
};

}  // namespace

Pose Retreated(const Workcell& workcell, const Pose& X_WorldTool) {
  return X_WorldTool * Translation(0, 0, -workcell.rules().approach_distance);
}

PartId PartOf(const domain::Problem& problem, const Action& action) {
  return std::visit(PartOfAction{problem}, action);
}

ToolRoute RouteOf(const domain::Problem& problem, const PlannedStep& step,
                  const Pose& X_WorldPart) {
  return std::visit(RouteOfAction{problem, X_WorldPart, step.strategy}, step.action);
}

ToolRoute RouteOf(const domain::Problem& problem, const Pickup& pickup, const Pose& X_WorldPart) {
  const Workcell& workcell = *problem.workcell;
  const Pose grasp = X_WorldPart * pickup.hold.X_PartTool;
  return {
      .poised = Retreated(workcell, grasp), .to_work = {grasp}, .away = {Lifted(workcell, grasp)}};
}

ToolRoute RouteOf(const domain::Problem& problem, const Putdown& putdown) {
  const Workcell& workcell = *problem.workcell;
  const Pose placed = putdown.to.X_WorldPart * putdown.hold.X_PartTool;
  return {.poised = Lifted(workcell, placed),
          .to_work = {placed},
          .away = {Retreated(workcell, placed)}};
}

ToolRoute RouteOf(const domain::Problem& problem, const Assemble& assemble,
                  const Pose& X_WorldFixed) {
  const domain::Mating& mating = problem.mating(assemble.mating);
  const Pose mated = X_WorldFixed * mating.X_FixedHeld * assemble.hold.X_PartTool;
  return {.poised = Translation(-(X_WorldFixed.linear() * mating.mating_vector)) * mated,
          .to_work = {mated},
          .away = {Retreated(*problem.workcell, mated)}};
}

ToolRoute RouteOf(const domain::Problem& problem, const Assemble& assemble,
                  const Strategy& strategy, const Pose& X_WorldFixed) {
  const domain::Mating& mating = problem.mating(assemble.mating);
  const Pose mated = X_WorldFixed * mating.X_FixedHeld * assemble.hold.X_PartTool;
  const Pose start = X_WorldFixed * strategy.X_FixedStart * strategy.X_HeldTip.inverse() *
                     assemble.hold.X_PartTool;
  // The line is along the mating vector, from the distance at which a straight mating would begin.
  const Vector3 direction = mating.mating_vector.normalized();
  const Vector3 way =
      mating.X_FixedHeld * strategy.X_HeldTip.translation() - strategy.X_FixedStart.translation();
  const double before = std::max(0.0, mating.mating_vector.norm() - way.dot(direction));
  return {.poised = Translation(-before * (X_WorldFixed.linear() * direction)) * start,
          .to_work = {start},
          .away = {Retreated(*problem.workcell, mated)}};
}

ToolRoute RouteOf(const domain::Problem& problem, const Squeeze& squeeze, const Pose& X_WorldPart) {
  const Workcell& workcell = *problem.workcell;
  const Pose grasp = X_WorldPart * squeeze.hold.X_PartTool;
  const Pose retreated = Retreated(workcell, grasp);
  return {.poised = retreated, .to_work = {grasp}, .away = {retreated}};
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
