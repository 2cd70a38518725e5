#pragma once

#include <span>
#include <vector>

#include "planner/plan/certificates/coverage.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {

// The work of the hand in a step, and the errors that are known as the hand does it.
struct HandWork {
  const UncertainWorld& world;  // before the action's effects
  const plan::Action& action;
  const plan::Strategy* strategy;  // null if no strategy executes the step
  PartId part;                     // the part that the hand handles
  const plan::Hold& hold;
  ManipulatorError draw;  // the hand's error at its commanded pose
  HeldError held;         // the part's error between the closed pads
  // These members are set for steps that let the part go: putdown and assemble.
  Transform X_ToolGrasp = {};           // T'_d
  Pose X_WorldPart = Pose::Identity();  // the planned pose at which the part is let go
  Expression table = 0;                 // height error of the table, metres; 0 for assemble
  Expression farther = 0;               // metres that the guarded descent goes on; 0 for assemble
  RestingError released = {};           // the part's error once it is let go
};

// A rule that derives the preconditions of one or several kinds for a step.
struct Derivation {
  plan::NeededBy needed_by;  // the steps for which it derives preconditions
  plan::Origin origin;
  bool is_of_release;  // true if it uses HandWork::released
  std::vector<Precondition> (*derive)(const HandWork& work);
};

// The preconditions of which certificates are made: their kinds, and the rules that derive them. A
// certificate lists preconditions in the order of the rules. The kinds about the arm's way have no
// rule here (planner/assembly/travel/way_conditions.h).
struct Theory {
  plan::ConditionKinds kinds = plan::KnownConditions();
  std::span<const Derivation> derivations = KnownDerivations();

  // Returns the planner's own rules.
  static std::span<const Derivation> KnownDerivations();
};

}  // namespace assay::uncertainty
