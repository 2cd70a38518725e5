#include "planner/constraint_posting/step_geometry.h"

#include "planner/domain/matings/mating_classes.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/pose.h"

namespace assay::constraint_posting {

using domain::Grasp;
using domain::GraspId;
using domain::Mating;
using domain::MatingId;
using domain::PartId;
using domain::PlacedPart;
using domain::Pose;

void Add(const Blockers& more, Blockers& blockers) {
  for (const auto& [blocker, why] : more) {
    std::string& known = blockers[blocker];
    if (known.empty()) known = why;
  }
}

void Blame::AddPlace(int choice) {
  choices.set(choice);
  places.set(choice);
}

void Blame::Add(int choice, StepId step, PartId part, const std::string& why) {
  if (choice == World::kStartChoice) {
    constraint_posting::Add({{{step, part}, why}}, blockers);
  } else {
    AddPlace(choice);
  }
}

void Blame::Add(const Blame& other) {
  choices |= other.choices;
  places |= other.places;
  constraint_posting::Add(other.blockers, blockers);
}

bool StepGeometry::HandIsFree(const World& world, StepId step, PartId part, PartId except,
                              const Grasp& grasp, const Pose& X_WorldTool, Blame& blame) const {
  const domain::Workcell& workcell = *problem_.workcell;
  const std::vector<PlacedPart> others = world.Others(part, except);
  const Pose X_WorldRetreated =
      X_WorldTool * geometry::Translation(0, 0, -workcell.rules().approach_distance);
  const double open = workcell.gripper().max_opening();
  for (const auto& [X_World, opening] :
       {std::pair{X_WorldTool, grasp.width}, {X_WorldTool, open}, {X_WorldRetreated, open}}) {
    const PartId obstacle = Obstacle(problem_, X_World, opening, others);
    if (obstacle.IsNone()) continue;
    blame.Add(world.choice(obstacle), step, obstacle);
    return false;
  }
  return true;
}

bool StepGeometry::Works(const World& world, StepId step, const domain::ActionTemplate& action,
                         GraspId grasp, const Pose& X_WorldPart, Blame& blame) const {
  if (action.kind->leaves == domain::Leaves::kAtPlace &&
      !HasRoom(world, step, action.part, X_WorldPart, blame)) {
    return false;
  }
  return WorksGivenRoom(world, step, action, grasp, X_WorldPart, blame);
}

bool StepGeometry::WorksGivenRoom(const World& world, StepId step,
                                  const domain::ActionTemplate& action, GraspId grasp,
                                  const Pose& X_WorldPart, Blame& blame) const {
  const domain::ActionKind& kind = *action.kind;
  if (kind.leaves == domain::Leaves::kMated) {
    return MatingWorks(world, step, action.mating, grasp, blame);
  }
  if (kind.Needs(domain::Need::kAlone) && world.mated(action.part)) return false;
  if (!kind.Has(domain::Argument::kGrasp)) return true;
  const bool is_placed = kind.leaves == domain::Leaves::kAtPlace;
  return HandWorks(world, step, action.part, grasp,
                   is_placed ? X_WorldPart : world.X_WorldPart(action.part), blame) &&
         (kind.leaves != domain::Leaves::kInHand ||
          PartLeaves(world, step, action.part, grasp, blame));
}

// A part that goes up would push up another part that stands on it.
bool StepGeometry::PartLeaves(const World& world, StepId step, PartId part, GraspId grasp,
                              Blame& blame) const {
  constexpr double kFirst = 0.1;  // share of the straight way that leads off a touching part
  const Pose& X_WorldPart = world.X_WorldPart(part);
  const Pose& X_PartTool = (*problem_.part(part).grasps)[grasp.index()].X_PartTool;
  const geometry::Vector3 way = -problem_.workcell->rules().approach_distance *
                                (X_WorldPart.linear() * X_PartTool.linear().col(2));
  for (const double share : {kFirst, 1.0}) {
    const PlacedPart lifted = {part, geometry::Translation(share * way) * X_WorldPart};
    const PartId obstacle = Obstacle(problem_, lifted, world.Others(part));
    if (obstacle.IsNone()) continue;
    blame.Add(world.choice(obstacle), step, obstacle);
    return false;
  }
  return true;
}

bool StepGeometry::TakingWorks(const World& world, StepId step, PartId part, GraspId grasp,
                               Blame& blame) const {
  return !world.mated(part) && HandWorks(world, step, part, grasp, world.X_WorldPart(part), blame);
}

bool StepGeometry::HandWorks(const World& world, StepId step, PartId part, GraspId grasp_id,
                             const Pose& X_WorldPart, Blame& blame) const {
  if (!reachability_.IsReachableAt(part, grasp_id, X_WorldPart)) return false;
  const Grasp& grasp = (*problem_.part(part).grasps)[grasp_id.index()];
  return HandIsFree(world, step, part, PartId::None(), grasp, X_WorldPart * grasp.X_PartTool,
                    blame);
}

bool StepGeometry::HasRoom(const World& world, StepId step, PartId part, const Pose& X_WorldPart,
                           Blame& blame) const {
  if (!OnTable(problem_, part, X_WorldPart)) return false;
  const PartId crowding = Crowding(problem_, part, X_WorldPart, world.Others(part));
  if (!crowding.IsNone()) blame.Add(world.choice(crowding), step, crowding);
  return crowding.IsNone();
}

bool StepGeometry::HeldPartIsFree(const World& world, StepId step, const Mating& mating,
                                  const Pose& X_WorldHeld, Blame& blame) const {
  const PartId obstacle = Obstacle(problem_, {.part = mating.held, .X_WorldPart = X_WorldHeld},
                                   world.Others(mating.held, mating.fixed));
  if (!obstacle.IsNone()) blame.Add(world.choice(obstacle), step, obstacle);
  return obstacle.IsNone();
}

bool StepGeometry::MatingWorks(const World& world, StepId step, MatingId mating_id,
                               GraspId grasp_id, Blame& blame) const {
  const Mating& mating = problem_.mating(mating_id);
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  if (!InFrictionCone(problem_, mating, X_WorldFixed) ||
      !reachability_.IsMateReachableAt(mating_id, grasp_id, X_WorldFixed)) {
    return false;
  }
  const Grasp& grasp = (*problem_.part(mating.held).grasps)[grasp_id.index()];
  for (const Pose& X_FixedHeld :
       {mating.X_FixedHeld, geometry::Translation(-mating.mating_vector) * mating.X_FixedHeld}) {
    const Pose X_WorldHeld = X_WorldFixed * X_FixedHeld;
    if (!HeldPartIsFree(world, step, mating, X_WorldHeld, blame) ||
        !HandIsFree(world, step, mating.held, mating.fixed, grasp, X_WorldHeld * grasp.X_PartTool,
                    blame)) {
      return false;
    }
  }
  return true;
}

}  // namespace assay::constraint_posting
