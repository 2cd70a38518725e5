#pragma once

#include <functional>
#include <optional>

#include "planner/motion/collision/surroundings.h"
#include "planner/motion/paths/joint_trajectory.h"
#include "sim/execution/robots/collision_watch.h"
#include "sim/execution/robots/executor_options.h"
#include "sim/execution/robots/kinematic_motion.h"
#include "sim/execution/world_model/world_model.h"
#include "sim/scene/servo.h"

namespace assay::execution {

using kinematics::JointVector;
using motion::JointTrajectory;

// The reason why an execution cannot go on.
struct Failure {
  TrialOutcome outcome;
  std::string reason;
};
using Progress = std::optional<Failure>;  // none if the execution goes on

// A snapshot of an execution, from which another execution of the same plan in the same scene can
// go on.
struct Checkpoint {
  mujoco::State state;
  WorldModel world;
  JointState commanded;
  Vector3 felt = Vector3::Zero();
  bool is_braced = false;
  Pose hand_error = Pose::Identity();
};

// The execution of a plan: the simulation, the last command to the arm, the world model and the
// trace.
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
  // Returns the believed pose of the tool, which is the last commanded pose.
  Pose BelievedTool() const;
  // Returns the tool's pose by the joints' own sensors.
  Pose MeasuredTool() const;
  // Returns the arm's surroundings: parts at their believed poses, and other robots by their
  // joints' sensors.
  motion::Surroundings BelievedSurroundings() const;
  Snapshot Now() const;
  std::int64_t steps() const { return steps_; }  // number of the engine's steps so far
  // Returns the greatest force at the wrist so far, in newtons, that lasted for some milliseconds.
  double greatest_force() const { return greatest_force_; }

  // Sets the arm to these joint values, at rest. It jumps there, for the start of a trial.
  void Place(const JointVector& q);
  // Sets the force at the wrist, in newtons, above which the arm stops.
  void LimitForce(double newtons) { force_limit_ = newtons; }
  double force_limit() const { return force_limit_; }
  // Returns whether a finger touches the part that the hand is believed to hold.
  bool IsInHand() const;
  // Sets the hand's error (noise::Noise::HandError).
  void SetHandError(const Pose& error) { hand_error_ = error; }
  const Pose& hand_error() const { return hand_error_; }
  // Sets the hand's error, and moves the hand to the pose that it then believes to have.
  Progress TakeUpHandError(const Pose& error);
  // Returns the true pose of the tool when it is commanded to X_WorldTool.
  Pose Erring(const Pose& X_WorldTool) const { return X_WorldTool * hand_error_; }
  // Sets the parts that the hand may touch from here on (CollisionWatch).
  void Handle(std::vector<PartId> parts, HeldTouches held = HeldTouches::kAnything) {
    collisions_.Handle(std::move(parts), held);
  }
  void SetStep(plan::StepId step) { step_ = step; }
  plan::StepId step() const { return step_; }

  // Follows the trajectory, without dynamics where that is possible (KinematicMotion).
  Progress Follow(const JointTrajectory& trajectory);
  // Follows the trajectory until the arm feels the force (newtons) against `direction`. The arm
  // then rests where it is.
  struct Guarded {
    double force = 0;
    Vector3 direction = Vector3::Zero();
  };
  Progress Follow(const JointTrajectory& trajectory, const Guarded& guarded);
  // Moves the fingers until they are commanded to this opening, metres between the pads, at this
  // rate of the opening in m/s, or until `has_ended` says so after a timestep. Fingers that touch
  // nothing move without dynamics.
  Progress MoveFingers(double opening, double rate, const std::function<bool()>& has_ended = {});
  // Makes the servos of the arm stiffer until Relax, or until the arm moves. Otherwise the friction
  // of a part that closing pads push over its support would move the arm by the yield of its
  // servos, some micrometres per newton.
  void Brace() { is_braced_ = true; }
  void Relax() { is_braced_ = false; }
  // Keeps the robot at its last command, for at least one timestep. Once nothing moves any more,
  // most of the time passes without dynamics. Calls `see` after each timestep with dynamics.
  Progress Stay(double seconds, const std::function<void()>& see = {});
  // Executes one timestep with soft servos, so that what touches the hand can move it.
  // `share` is the fraction of the servos' usual stiffness. `qdd` is the planned acceleration, so
  // that the arm does not lag.
  Progress StepSoftly(const JointState& next, const JointVector& qdd, double share);
  // Moves with soft servos toward `next`, where it would be after so many seconds, without
  // dynamics. Returns how many seconds it moved: 0 if a force decides something.
  double GlideSoftly(const JointState& next, double seconds);
  // Returns the time until which a motion without dynamics may last, in seconds of the simulation,
  // or the present time.
  double KinematicUntil() const;
  // Makes motions without dynamics independent of the motions before.
  void ForgetKinematics();

  // Sets the last command to the robot to the arm's measured state.
  void TakeStock();

  Checkpoint Save() const;
  void Restore(const Checkpoint& checkpoint);

 private:
  static constexpr double kRounding = 1e-9;  // of times, seconds

  // The command at each time of a motion, in seconds after its start.
  using Commands = std::function<RobotCommand(double)>;
  // Moves without dynamics from `time` on, to `end` at most, if that is possible. Returns the time
  // that is reached.
  double MoveKinematically(const Commands& commands, double time, double end);
  // Returns the time, in seconds, at which the engine must compute the forces again.
  static double NextForces(double now);
  // Lets time pass in which nothing moves, until the engine must compute the forces again, or until
  // `end`, in seconds of the simulation.
  void PassTime(double end);
  // Returns the command that makes the servos hold the arm to the wanted state with this share of
  // their usual stiffness.
  JointState WithStiffness(double share, const JointState& wanted) const;
  // Executes one timestep that leads the arm to this state. It adds to the trace's series and
  // checks force and engine.
  Progress StepTo(const JointState& next);
  // Executes the timestep after the servos have their commands.
  Progress Advance(const JointState& next);
  scene::Load Carried() const;
  void StepEngine();
  // Counts the timestep that has ended, and shows it to the observers.
  void EndTimestep();
  bool IsSampleDue() const;
  void SampleIfDue();
  void RecordCollisions();
  Progress Watch();
  // Takes into account that the wrist has felt the present reading for some time, seconds.
  void Feel(double seconds);

  const domain::Problem& problem_;
  const scene::Scene& scene_;
  mujoco::Data& data_;
  const ExecutorOptions& options_;
  scene::JointServo servo_;
  WorldModel world_;
  CollisionWatch collisions_;
  KinematicMotion kinematic_;
  double near_until_ = 0;  // no motion without dynamics before this time, seconds
  Trace trace_;
  JointState commanded_;
  Pose hand_error_ = Pose::Identity();
  plan::StepId step_;
  int samples_ = 0;
  std::int64_t steps_ = 0;
  bool is_braced_ = false;
  Vector3 felt_ = Vector3::Zero();  // low-pass filtered wrist force
  Vector3 peak_ = Vector3::Zero();  // wrist force with a shorter filter
  double greatest_force_ = 0;
  double force_limit_;
};

}  // namespace assay::execution
