#pragma once

#include <bitset>
#include <map>
#include <string>
#include <utility>

#include "planner/constraint_posting/partial_plan.h"
#include "planner/constraint_posting/world.h"

namespace assay::constraint_posting {

// The greatest number of steps of a plan instance. Choices is a set of positions in the order of
// execution.
inline constexpr int kMostSteps = 256;
using Choices = std::bitset<kMostSteps>;

// A part that is in the way of a step while it rests where it was at the start.
using Blocker = std::pair<StepId, domain::PartId>;
// The text says what cannot be proved as long as the blocking part is there. The text is empty if
// the step cannot even be executed.
using Blockers = std::map<Blocker, std::string>;
// Adds `more` to `blockers`. A text about an unproved precondition replaces an empty text, because
// it says more.
void Add(const Blockers& more, Blockers& blockers);

// The reasons why a value of a step is ruled out: choices made for earlier steps, and parts that
// still lie where they were at the start.
struct Blame {
  Choices choices = {};
  Choices places = {};  // the choices whose place on the table takes part, and not only their label
  Blockers blockers = {};

  void AddPlace(int choice);
  // Adds a part that `choice` put where it is.
  void Add(int choice, StepId step, domain::PartId part, const std::string& why = "");
  void Add(const Blame& other);
};

// Tests whether single steps work in a world in which every part has its place. A test that fails
// adds to the blame every reason for the failure except the tested value itself.
class StepGeometry {
 public:
  StepGeometry(const domain::Problem& problem, domain::KnownReachability& reachability)
      : problem_(problem), reachability_(reachability) {}

  // Tests an action. X_WorldPart is the pose in which the action leaves the part. It is used only
  // if the action leaves the part at a place.
  bool Works(const World& world, StepId step, const domain::ActionTemplate& action,
             domain::GraspId grasp, const domain::Pose& X_WorldPart, Blame& blame) const;
  // Tests an action, except for the room of a part that is left at a place.
  bool WorksGivenRoom(const World& world, StepId step, const domain::ActionTemplate& action,
                      domain::GraspId grasp, const domain::Pose& X_WorldPart, Blame& blame) const;

  // Returns true if the hand can take the part from where it is in the world.
  bool TakingWorks(const World& world, StepId step, domain::PartId part, domain::GraspId grasp,
                   Blame& blame) const;
  // Returns true if the hand can let the part go, or grasp it, in this pose.
  bool HandWorks(const World& world, StepId step, domain::PartId part, domain::GraspId grasp,
                 const domain::Pose& X_WorldPart, Blame& blame) const;
  // Returns true if the part has room in this pose, whatever holds it.
  bool HasRoom(const World& world, StepId step, domain::PartId part,
               const domain::Pose& X_WorldPart, Blame& blame) const;
  bool MatingWorks(const World& world, StepId step, domain::MatingId mating, domain::GraspId grasp,
                   Blame& blame) const;

 private:
  bool HandIsFree(const World& world, StepId step, domain::PartId part, domain::PartId except,
                  const domain::Grasp& grasp, const domain::Pose& X_WorldTool, Blame& blame) const;
  // Returns true if the hand can draw the part back from where it is in the world.
  bool PartLeaves(const World& world, StepId step, domain::PartId part, domain::GraspId grasp,
                  Blame& blame) const;
  bool HeldPartIsFree(const World& world, StepId step, const domain::Mating& mating,
                      const domain::Pose& X_WorldHeld, Blame& blame) const;

  const domain::Problem& problem_;
  domain::KnownReachability& reachability_;
};

}  // namespace assay::constraint_posting
