#include "planner/constraint_posting/impossibility/constraint_situation.h"

#include <algorithm>

#include "planner/base/check.h"
#include "planner/domain/actions/condition.h"
#include "planner/domain/matings/mating_classes.h"

namespace assay::constraint_posting {

using domain::Mating;
using domain::Part;
using domain::PartId;
using domain::Pose;
using domain::Problem;
using domain::StablePoseId;
using Kind = Constraint::Kind;

namespace {

// A workcell without placements shows the part where it starts.
Pose ShownAt(const Problem& problem, PartId part, int position) {
  const std::vector<Pose> poses = PosesAt(problem, part, position);
  return poses.empty() ? problem.part(part).X_WorldPart : poses.front();
}

// Returns the first stable pose of the fixed part in which the table hides mating features, or
// outside of which the mating vector is in the friction cone. Returns its pose at the start if
// there is none.
int FailingPosition(const Problem& problem, const Mating& mating, Kind kind) {
  const Part& fixed = problem.part(mating.fixed);
  const auto& poses = fixed.model->stable_poses();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool fails = kind == Kind::kFeaturesOffTable
                           ? HidesMatingFeatures(problem, mating, StablePoseId(i))
                           : !InFrictionCone(problem, mating, poses[i].X_TablePart);
    if (fails) return static_cast<int>(i);
  }
  return domain::InitialLabel(fixed);
}

plan::Situation Mated(const Problem& problem, const Mating& mating, int position) {
  const Pose X_WorldFixed = ShownAt(problem, mating.fixed, position);
  return {
      .parts = {{mating.held, X_WorldFixed * mating.X_FixedHeld}, {mating.fixed, X_WorldFixed}}};
}

plan::Situation Located(const Problem& problem, const domain::LocatedGoal& goal) {
  const int position = goal.stable_poses.front().index();
  return {.parts = {{goal.part, ShownAt(problem, goal.part, position)}}};
}

}  // namespace

plan::Situation MatedAt(const RelaxedProblem& relaxed, domain::MatingId mating, int position) {
  return Mated(relaxed.problem(), relaxed.problem().mating(mating), position);
}

plan::Situation SituationOf(const RelaxedProblem& relaxed, const HoldOption& hold) {
  const Problem& worked = relaxed.hands()[hold.robot]->problem();
  const domain::Grasp& grasp = (*worked.part(hold.part).grasps)[hold.grasp];
  plan::Situation situation =
      hold.mating.IsNone()
          ? plan::Situation{.parts = {{hold.part, ShownAt(worked, hold.part, hold.position)}}}
          : Mated(worked, worked.mating(hold.mating), hold.position);
  situation.hand =
      plan::PlacedHand{.robot = domain::RobotId(hold.robot),
                       .X_WorldTool = situation.parts.front().X_WorldPart * grasp.X_PartTool,
                       .opening = std::min(grasp.width, worked.workcell->gripper().max_opening())};
  return situation;
}

std::optional<plan::Situation> SituationOf(const RelaxedProblem& relaxed,
                                           const Constraint& constraint) {
  const Problem& problem = relaxed.problem();
  const int index = constraint.index;
  switch (constraint.kind) {
    case Kind::kGraspCondition:
      return std::nullopt;
    case Kind::kGrasps:
    case Kind::kStart:
      return plan::Situation{.parts = {{PartId(index), problem.parts[index].X_WorldPart}}};
    case Kind::kInTheWay:
      return plan::Situation{.parts = {{PartId(index), problem.parts[index].X_WorldPart}},
                             .colliding = {{.part = PartId(index)}}};
    case Kind::kLocated:
      return Located(problem, std::get<domain::LocatedGoal>(problem.goals[index]));
    case Kind::kFeaturesOffPads:
    case Kind::kFeaturesOffTable:
    case Kind::kFrictionCone: {
      const Mating& mating = problem.matings[index];
      return Mated(problem, mating, FailingPosition(problem, mating, constraint.kind));
    }
  }
  ASSAY_CHECK(false, "a kind of constraint that the switch does not know");
  return std::nullopt;
}

}  // namespace assay::constraint_posting
