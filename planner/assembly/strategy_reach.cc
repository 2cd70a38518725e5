#include "planner/assembly/strategy_reach.h"

#include <utility>
#include <vector>

#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/reachability/reachability.h"
#include "planner/domain/reachability/tool_path.h"

namespace assay::assembly {
namespace {

using domain::PartId;
using geometry::Pose;
using kinematics::JointVector;

// Returns the tool's poses at the start of a strategy and at the ends of its motions.
std::vector<Pose> ToolsOf(const plan::Action& assemble, const plan::Strategy& strategy) {
  const Pose X_TipTool = strategy.X_HeldTip.inverse() * assemble.hold.X_PartTool;
  std::vector<Pose> tools = {assemble.place.X_WorldPart * strategy.X_FixedStart * X_TipTool};
  for (const plan::StrategyMotion& motion : strategy.motions)
    tools.push_back(assemble.place.X_WorldPart * motion.X_FixedTip * X_TipTool);
  return tools;
}

std::vector<domain::PlacedPart> AllBut(PartId held, const plan::WorldState& state) {
  std::vector<domain::PlacedPart> others;
  for (std::size_t p = 0; p < state.parts.size(); ++p) {
    if (PartId(p) != held) others.push_back({PartId(p), state.parts[p].X_WorldPart});
  }
  return others;
}

std::vector<plan::Hold> OtherHolds(const domain::Problem& problem, const plan::Action& assemble) {
  const PartId held = problem.mating(assemble.mating).held;
  const domain::Part& part = problem.part(held);
  std::vector<plan::Hold> holds;
  for (std::size_t g = 0; g < part.grasps->size(); ++g) {
    const domain::GraspId id(g);
    const domain::Grasp& grasp = (*part.grasps)[g];
    if (grasp.label != assemble.hold.grasp &&
        LeavesMatingFeaturesFree(problem, problem.mating(assemble.mating), id) &&
        IsReachableAt(problem, held, id, part.X_WorldPart) &&
        IsMateReachableAt(problem, assemble.mating, id, assemble.place.X_WorldPart)) {
      holds.push_back({grasp.label, grasp.X_PartTool, grasp.width});
    }
  }
  return holds;
}

}  // namespace

StrategyReach ReachOf(const domain::Problem& problem, const plan::Action& assemble,
                      const plan::Strategy& strategy, const plan::WorldState& before) {
  const std::vector<Pose> tools = ToolsOf(assemble, strategy);
  const auto others = AllBut(problem.mating(assemble.mating).held, before);
  const domain::PathReach reach = ReachAlong(*problem.workcell, tools);
  for (std::size_t i = 0; i < tools.size(); ++i) {
    const PartId obstacle = Obstacle(problem, tools[i], assemble.hold.width, others);
    if (i >= reach.reached || !obstacle.IsNone())
      return Unreached{static_cast<int>(i), tools[i], obstacle};
  }
  return *reach.start;
}

std::variant<ReachingHold, Unreached> ChooseHold(const domain::Problem& problem,
                                                 const plan::Action& assemble,
                                                 const plan::Strategy& strategy) {
  const plan::WorldState before = plan::InitialState(problem);
  const StrategyReach own = ReachOf(problem, assemble, strategy, before);
  if (const auto* start = std::get_if<JointVector>(&own))
    return ReachingHold{assemble.hold, *start};
  plan::Action other = assemble;
  for (plan::Hold& hold : OtherHolds(problem, assemble)) {
    other.hold = std::move(hold);
    const StrategyReach reach = ReachOf(problem, other, strategy, before);
    if (const auto* start = std::get_if<JointVector>(&reach))
      return ReachingHold{std::move(other.hold), *start};
  }
  return std::get<Unreached>(own);
}

}  // namespace assay::assembly
