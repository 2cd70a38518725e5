#pragma once

#include <bitset>
#include <map>
#include <string>
#include <utility>

#include "planner/posting/partial_plan.h"
#include "planner/posting/world.h"

namespace assay::posting {

// Positions in an order of execution.
inline constexpr int kMostSteps = 256;
using Choices = std::bitset<kMostSteps>;

// A part that, resting where it was at the start, is in the way of a step.
using Blocker = std::pair<StepId, domain::PartId>;
// With what cannot be proved as long as it is there; empty: the step cannot be executed.
using Blockers = std::map<Blocker, std::string>;
// Adds them; what cannot be proved tells more than that a step cannot be executed with some value.
void Add(const Blockers& more, Blockers& blockers);

// Who rules a value of a step out: choices made for earlier steps, and parts that still lie where
// they were at the start.
struct Blame {
  Choices choices = {};
  Choices places =
      {};  // of these, those whose place on the table takes part, and not the label alone
  Blockers blockers = {};

  void AddPlace(int choice);
  // A part that `choice` put where it is.
  void Add(int choice, StepId step, domain::PartId part, const std::string& why = "");
  void Add(const Blame& other);
};

// Whether single steps work in a world in which every part has its place. Each test that fails
// adds to the blame whatever else than the tested value itself made it fail.
class StepGeometry {
 public:
  StepGeometry(const domain::Problem& problem, domain::KnownReachability& reachability)
      : problem_(problem), reachability_(reachability) {}

  bool PickupWorks(const World& world, StepId step, domain::PartId part, domain::GraspId grasp,
                   Blame& blame) const;

  // Whether the part finds room there, whatever holds it.
  bool HasRoom(const World& world, StepId step, domain::PartId part,
               const domain::Pose& X_WorldPart, Blame& blame) const;
  bool PutdownWorks(const World& world, StepId step, domain::PartId part, domain::GraspId grasp,
                    const domain::Pose& X_WorldPart, Blame& blame) const;

  bool AssembleWorks(const World& world, StepId step, domain::MatingId mating,
                     domain::GraspId grasp, Blame& blame) const;

 private:
  bool HandIsFree(const World& world, StepId step, domain::PartId part, domain::PartId except,
                  const domain::Grasp& grasp, const domain::Pose& X_WorldTool, Blame& blame) const;
  bool HeldPartIsFree(const World& world, StepId step, const domain::Mating& mating,
                      const domain::Pose& X_WorldHeld, Blame& blame) const;

  const domain::Problem& problem_;
  domain::KnownReachability& reachability_;
};

}  // namespace assay::posting
