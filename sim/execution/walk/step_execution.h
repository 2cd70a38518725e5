#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/execution/commands/action_commands.h"
#include "sim/execution/robots/execution.h"

namespace assay::execution {

// The execution of one step of a plan: the approach, then the work with its verifications and
// recoveries (Spar, figures 11 and 12).
class StepExecution {
 public:
  // `plan` and `execution` must outlive this object.
  StepExecution(const plan::Plan& plan, plan::StepId step, Execution& execution);

  // Sets the hand's error for this step and the table's height for the place, and moves the tool to
  // the pose before or above its work. The tool is then poised for the step.
  Progress Approach();
  // Sets the errors of the step to the errors of the execution's noise. The tool must be poised for
  // the step.
  Progress TakeUpNoise();
  // Executes everything after the approach. When the hand gropes, the part (in a mating, the fixed
  // part) is believed to lie at the place that is tried.
  Progress Work();

  // The functions below execute parts of the work, for walking a plan tree or for falsification.
  // Advance moves the tool to where it acts.
  Progress Advance();
  // Advances and acts, without verification.
  Progress Attempt();
  // Returns the first error that a verification of this step signals; empty: none.
  std::string Verify();
  // Tries the step again at the next place that the recovery from this error lists. If no place is
  // left, it calls the operator.
  Progress TryAgain(const std::string& error);
  // Moves the tool away.
  Progress Finish();
  // Executes the rest of the work after an attempt: verifications, recoveries, and Finish.
  Progress Complete();

 private:
  enum class Phase { kApproach, kAdvance, kAct, kDepart };

  const std::vector<Command>& CommandsOf(Phase phase) const;
  std::vector<Command> After(Phase phase) const;
  Progress Run(Phase phase);
  Progress RunAll(const std::vector<Command>& commands, const std::vector<Command>& then);
  // Returns the parts that the hand may touch in this step.
  std::vector<PartId> HandledParts() const;
  void SetTables();
  void Record(Stage stage);
  // Adds the step's name to a failure's reason.
  Progress Named(Progress failure) const;

  double Measure(domain::MeasuredQuantity quantity) const;
  const plan::Recovery* RecoveryFrom(const std::string& error) const;  // null if the plan has none
  // Returns the places of the plan's recovery from the error, without those where the hand would
  // come too near to another part. It is empty if there is no recovery.
  std::vector<Vector3> PlacesFor(const std::string& error) const;
  // Returns the distance, in metres, of the hand from the parts that it does not handle, if it
  // works at this offset from the planned place. The parts are at their believed poses.
  double RoomAt(const Vector3& offset) const;
  Progress TryAt(const Vector3& offset);
  Progress Withdraw();
  Progress MoveSideways();
  Progress Probe();
  Vector3 Direction() const;

  const plan::Plan& plan_;
  const plan::PlannedStep& planned_;
  plan::StepId step_;
  Execution& execution_;
  // The part whose place is uncertain, its believed pose before groping, and the axis of the plane
  // in which groping moves.
  PartId sought_;
  Pose X_WorldSought_;
  Vector3 axis_;
  StepCommands commands_;
  Pose X_WorldTool_;                          // tool pose where the advance ends, before groping
  std::map<std::string, std::size_t> tried_;  // number of tried places for each error
};

}  // namespace assay::execution
