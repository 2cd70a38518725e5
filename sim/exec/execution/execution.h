#pragma once

#include <optional>
#include <span>

#include "planner/motion/clear/collision_scene.h"
#include "planner/motion/path/joint_trajectory.h"
#include "sim/exec/execution/collision_watch.h"
#include "sim/exec/execution/executor_options.h"
#include "sim/exec/execution/world_model.h"
#include "sim/scene/servo.h"

namespace assay::exec {

using kinematics::JointState;
using kinematics::JointVector;
using motion::JointTrajectory;

// Why an execution cannot go on.
struct Failure {
  ExecutionOutcome outcome;
  std::string reason;
};
using Progress = std::optional<Failure>;  // none: it goes on

// How finely time is divided.
enum class Stepping {
  kContact,  // the scene's timestep
  kFree,     // ExecutorOptions::free_timestep, if the hand is empty
};

// Where an execution is: what it takes to go on from there, in another execution of the same plan
// in the same scene.
struct Checkpoint {
  mujoco::State state;
  WorldModel world;
  JointState commanded;
  Vector3 felt = Vector3::Zero();
  Pose hand_error = Pose::Identity();
};

// A plan on its way: the simulation, what the arm was last told, the world model and the trace.
class Execution {
 public:
  Execution(const domain::Problem& problem, const scene::Scene& scene, mujoco::Data& data,
            const ExecutorOptions& options);

  const domain::Problem& problem() const { return problem_; }
  const scene::Scene& scene() const { return scene_; }
  const ExecutorOptions& options() const { return options_; }
  mujoco::Data& data() { return data_; }
  WorldModel& world() { return world_; }
  const WorldModel& world() const { return world_; }
  Trace& trace() { return trace_; }

  const JointVector& commanded() const { return commanded_.q; }
  // Where the hand believes itself to be: where it was last told to go.
  Pose BelievedTool() const;
  // Where it believes itself to be by the joints' own sensors.
  Pose MeasuredTool() const;
  // What the arm has around it: parts where they are believed to be, other robots where their
  // joints' sensors say.
  motion::Surroundings BelievedSurroundings() const;
  Moment Now() const;
  std::int64_t steps() const { return steps_; }  // of the engine, so far
  // Newtons at the wrist, the greatest so far that lasted for some milliseconds.
  double greatest_force() const { return greatest_force_; }

  // The arm is with these joint values, at rest: a jump, for the start of a trial.
  void Place(const JointVector& q);
  // From now on the arm stops where the wrist feels more newtons than this.
  void LimitForce(double newtons) { force_limit_ = newtons; }
  double force_limit() const { return force_limit_; }
  // Whether a finger touches the part that it is believed to hold.
  bool IsInHand() const;
  // From now on the hand errs so (noise::Noise::HandError).
  void SetHandError(const Pose& error) { hand_error_ = error; }
  // The same, and it goes where it now believes itself to be.
  Progress TakeUpHandError(const Pose& error);
  // Where the hand truly goes when it is told to go to X_WorldTool.
  Pose Erring(const Pose& X_WorldTool) const { return X_WorldTool * hand_error_; }
  // From now on the hand may touch these parts and no others (CollisionWatch).
  void Handle(std::vector<PartId> parts, HeldTouches held = HeldTouches::kAnything) {
    collisions_.Handle(std::move(parts), held);
  }
  void SetStep(plan::StepId step) { step_ = step; }
  plan::StepId step() const { return step_; }

  // The arm follows the trajectory, from `fine_from` (seconds from its start) on in small steps.
  Progress Follow(const JointTrajectory& trajectory, double fine_from);
  // The same; it stops where it feels the force against `direction`. Then the arm rests where it
  // is.
  struct Guarded {
    double force = 0;
    Vector3 direction = Vector3::Zero();
  };
  Progress Follow(const JointTrajectory& trajectory, double fine_from, const Guarded& guarded);
  // The arm stays where it was last told to be, for at least one timestep.
  Progress Stay(double seconds, Stepping stepping);
  // One small timestep with soft servos: their stiffness is this share of what it is otherwise, and
  // what touches the hand can move it. `qdd`: of what is planned, so that it does not lag.
  Progress StepSoftly(const JointState& next, const JointVector& qdd, double share);

  // What the arm was last told becomes where it is.
  void TakeStock();

  Checkpoint Save() const;
  void Restore(const Checkpoint& checkpoint);

 private:
  void SetStepping(Stepping stepping);
  // One timestep, after which the arm is to be in this state, with everything that belongs to it:
  // the trace's series, and the watch over force and engine.
  Progress StepTo(const JointState& next);
  // The same, with the servos told already.
  Progress Advance(const JointState& next);
  scene::Load Carried() const;
  void SampleIfDue();
  void RecordCollisions();
  Progress Watch();

  const domain::Problem& problem_;
  const scene::Scene& scene_;
  mujoco::Data& data_;
  const ExecutorOptions& options_;
  scene::JointServo servo_;
  WorldModel world_;
  CollisionWatch collisions_;
  Trace trace_;
  JointState commanded_;
  Pose hand_error_ = Pose::Identity();
  plan::StepId step_;
  int samples_ = 0;
  std::int64_t steps_ = 0;
  Vector3 felt_ = Vector3::Zero();  // wrist force, low-pass filtered
  Vector3 peak_ = Vector3::Zero();  // the same, with a lighter filter
  double greatest_force_ = 0;
  double force_limit_;
};

// The commands (one file each). `rest`: the commands that follow in the same step.
Progress Run(const MoveAtSafeHeight& move, std::span<const Command> rest, Execution& execution);
Progress Run(const FollowPath& follow, std::span<const Command> rest, Execution& execution);
Progress Run(const MoveStraight& move, std::span<const Command> rest, Execution& execution);
Progress Run(const OpenGripper& open, std::span<const Command> rest, Execution& execution);
Progress Run(const CloseGripper& close, std::span<const Command> rest, Execution& execution);
Progress Run(const Look& look, std::span<const Command> rest, Execution& execution);
Progress Run(const Clamp& clamp, std::span<const Command> rest, Execution& execution);
Progress Run(const FollowStrategy& follow, std::span<const Command> rest, Execution& execution);

}  // namespace assay::exec
