#pragma once

#include <map>
#include <string>
#include <vector>

#include "sim/exec/commands/action_commands.h"
#include "sim/exec/execution/execution.h"

namespace assay::exec {

// A step of a plan on its way: the approach, then the work, with the verifications that follow it
// and what is done about errors (Spar, figures 11 and 12).
class StepExecution {
 public:
  // `plan` and `execution` must outlive this.
  StepExecution(const plan::Plan& plan, plan::StepId step, Execution& execution);

  // The hand errs anew, the table is as high as it is there, and the tool goes to where it is
  // poised before or above its work.
  Progress Approach();
  // In a step that is poised: the errors are now as the execution's noise says.
  Progress TakeUpNoise();
  // All that comes after the approach. When the hand gropes, it is believed that the part (of a
  // mating: the fixed part) lies where it is tried.
  Progress Work();

  // The parts of the work, for who walks a plan tree or attacks a step. The tool goes to where it
  // acts:
  Progress Advance();
  // The same, and what the step is for, without looking how it went:
  Progress Attempt();
  // The first error that a verification of this step signals; empty: none.
  std::string Verify();
  // Tries the step at the next place that the recovery from the error has; where none is left, the
  // operator is called.
  Progress TryAgain(const std::string& error);
  // The tool departs.
  Progress Finish();

 private:
  enum class Phase { kApproach, kAdvance, kAct, kDepart };

  const std::vector<Command>& CommandsOf(Phase phase) const;
  std::vector<Command> After(Phase phase) const;
  Progress Run(Phase phase);
  Progress RunAll(const std::vector<Command>& commands, const std::vector<Command>& then);
  // What the hand may touch in this step.
  std::vector<PartId> HandledParts() const;
  void SetTables();
  void Record(Stage stage);
  // Explains a failure by the step's name.
  Progress Named(Progress failure) const;

  double Measure(domain::MeasuredQuantity quantity) const;
  const plan::Recovery* RecoveryFrom(const std::string& error) const;  // null: the plan has none
  // The places that the plan's recovery from the error has, but for those at which the hand would
  // come too near to another part; none if there is none.
  std::vector<Vector3> PlacesFor(const std::string& error) const;
  // How far the hand is from parts that it does not handle, as far as it knows, if it works so far
  // beside where the plan has it; metres.
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
  // The part whose place is in doubt, where it was believed to be before groping, and the direction
  // across which it is groped for.
  PartId sought_;
  Pose X_WorldSought_;
  Vector3 axis_;
  StepCommands commands_;
  Pose X_WorldTool_;                          // where the advance ends, before groping
  std::map<std::string, std::size_t> tried_;  // places, by error
};

}  // namespace assay::exec
