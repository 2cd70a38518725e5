#pragma once

#include <vector>

#include "planner/kinematics/arm.h"
#include "sim/scene/scene.h"

namespace assay::execution {

using domain::PartId;
using kinematics::JointState;

// What the servos of a robot are commanded to do: the state of the arm, and the opening of the
// gripper (metres) with its rate (m/s).
struct RobotCommand {
  JointState arm;
  double opening = 0;
  double opening_rate = 0;
};

// Motion of a robot without dynamics, for the time in which the engine's forces decide nothing: the
// robot and the part in its hand touch nothing else, the pads hold this part with much more
// friction than it needs, and everything else rests. The servos then lead the robot along its
// commands without a lag, since they know the dynamics of the arm and feel the load in the hand.
// The part in the hand keeps its pose there.
// Contacts are searched for only where the robot has moved farther than the least separation that
// was found before.
class KinematicMotion {
 public:
  explicit KinematicMotion(const scene::Scene& scene);

  // Judges by the forces of the contacts whether the pads hold the part firmly. Call it within
  // mujoco::Data::Step(see_forces).
  void SeeForces(const mujoco::Data& data, PartId held);
  // Forgets what SeeForces has seen. No motion begins before it sees forces again.
  void Forget() { is_firm_ = false; }

  // Begins a motion at the present state, if it allows one. `held` is the part in the hand, or
  // None, and `last` is the last command. A robot that is commanded to stand stays in dynamics
  // until nothing moves any more.
  bool Begin(const mujoco::Data& data, PartId held, const RobotCommand& last);
  // Moves to where the robot is commanded to be at a time of the simulation, seconds. If the
  // robot, or the part in its hand, would touch something there, it stays where it was, and the
  // answer is false. Call End or mujoco::Data::Resume before dynamics go on.
  bool MoveTo(const RobotCommand& next, double time, mujoco::Data& data);
  // Returns a speed in m/s that no point of the robot and of the held part exceeds when a command
  // has these rates.
  double GreatestSpeed(const RobotCommand& command) const;
  // Returns a length in metres by which all points of the robot may move before it can touch
  // anything. The bound is 0 unless MoveTo has found a greater one.
  double room() const { return room_; }
  // Ends the motion with the velocities of the last command, so that dynamics can go on.
  void End(mujoco::Data& data) const;

 private:
  bool IsQuiet(const mujoco::Data& data) const;
  bool RobotStandsStill(const mujoco::Data& data) const;
  bool TouchesAnything(const mujoco::Data& data) const;
  void Move(const RobotCommand& to, mujoco::Data& data);
  // Returns a length in metres that no point moves farther between two commands.
  double LongestWay(const RobotCommand& from, const RobotCommand& to) const;
  // Returns whether the robot and the held part touch nothing where they are now.
  bool IsClear(mujoco::Data& data);

  const scene::Scene& scene_;
  double reach_ = 0;  // metres from a joint to the farthest point of the robot that it moves
  bool is_firm_ = false;
  // The motion that has begun:
  std::vector<int> groups_;  // which bodies of the engine move together
  PartId held_;
  RobotCommand last_;
  double room_ = 0;
  geometry::Pose X_HandPart_ = geometry::Pose::Identity();
  double held_reach_ = 0;  // metres from the hand to the farthest point of the held part
};

}  // namespace assay::execution
