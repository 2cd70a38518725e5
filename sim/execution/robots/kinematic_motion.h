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
  // Forgets what SeeForces has seen, and where there was room. No motion begins before SeeForces
  // sees forces again.
  void Forget() {
    is_firm_ = false;
    room_ = 0;
    speed_ = 0;
  }

  // Returns whether nothing moves: the robot, the part in its hand, and all other parts.
  bool EverythingStands(const mujoco::Data& data) const;

  // Begins a motion at the present state, if it allows one. `held` is the part in the hand, or
  // None, and `last` is the last command.
  bool Begin(const mujoco::Data& data, PartId held, const RobotCommand& last);
  // Moves to where the robot is commanded to be at a time of the simulation, seconds. If the
  // robot, or the part in its hand, would touch something there, it stays where it was, and the
  // answer is false. Call End or mujoco::Data::Resume before dynamics go on.
  bool MoveTo(const RobotCommand& next, double time, mujoco::Data& data);
  // Returns for how many seconds the robot may go on from this command before it must be looked
  // whether it touches anything.
  double MayGoOn(const RobotCommand& command) const;
  // Ends the motion with the velocities of the last command, so that dynamics can go on.
  void End(mujoco::Data& data) const;

 private:
  // Makes `held` the part that moves with the hand.
  void Take(PartId held);
  bool IsQuiet(const mujoco::Data& data) const;
  bool TouchesAnything(const mujoco::Data& data) const;
  void Move(const RobotCommand& to, mujoco::Data& data);
  // Returns by how many metres a point has moved, at most, since the last call.
  double GreatestWay(const mujoco::Data& data);
  // Returns whether the robot and the held part touch nothing where they are now.
  bool IsClear(mujoco::Data& data);

  // A body that moves with the robot.
  struct Mover {
    mujoco::BodyId body;
    double reach = 0;  // metres from the body's origin to its farthest point
    geometry::Pose X_WorldBody = geometry::Pose::Identity();
  };

  const scene::Scene& scene_;
  std::vector<Mover> links_;  // of the arm and the hand
  double length_ = 0;         // metres from a joint to the farthest point of the robot, at most
  bool is_firm_ = false;
  // The motion that has begun:
  std::vector<int> groups_;  // which bodies of the engine move together
  PartId held_;
  RobotCommand last_;
  double room_ = 0;   // metres by which all points may move before the robot can touch anything
  double speed_ = 0;  // m/s of the fastest point in the last move
  geometry::Pose X_HandPart_ = geometry::Pose::Identity();
  std::vector<Mover> movers_;
};

}  // namespace assay::execution
