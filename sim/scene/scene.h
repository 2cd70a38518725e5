#pragma once

#include <array>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/kinematics/arm.h"
#include "planner/kinematics/dynamics/arm_dynamics.h"
#include "sim/mujoco/contact.h"
#include "sim/mujoco/data.h"
#include "sim/mujoco/model.h"
#include "sim/scene/mjcf.h"

namespace assay::scene {

using domain::PartId;
using geometry::Pose;
using geometry::Vector3;
using kinematics::JointVector;

using kinematics::kGravity;

// A force, newtons, and a torque about a point, newton metres.
struct Wrench {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
};

// The joint values of an arm in radians, joint 1 first, and the opening of its gripper, metres
// between the pads.
struct ArmPosture {
  JointVector q = JointVector::Zero();
  double opening = 0;
};

// The velocity of a body's origin and the body's angular velocity, world frame.
struct Twist {
  Vector3 linear = Vector3::Zero();   // m/s
  Vector3 angular = Vector3::Zero();  // rad/s
};

// The kinds of bodies in the engine.
enum class BodyKind {
  kWorld,  // tables and floor
  kPart,
  kArm,   // a link of an arm, its foot included
  kHand,  // hand or finger
};

// The indices of the six arm joints in the engine's arrays, joint 1 first.
struct ArmAddresses {
  std::array<int, 6> qpos{};
  std::array<int, 6> dof{};   // index in qvel, qfrc_applied and qfrc_bias
  std::array<int, 6> ctrl{};  // index of the joint's position servo
};

// The workcell of a problem in the engine, from the view of the acting robot: arm, gripper, hand,
// tool and wrist belong to that robot. A scene is immutable, so that threads can share it, each
// with its own Data.
class Scene {
 public:
  Scene(const domain::Problem& problem, const SceneOptions& options);
  // Returns this scene with another acting robot. Both scenes have the same model and work on the
  // same Data.
  Scene WorkedBy(domain::RobotId robot) const;

  const mujoco::Model& model() const { return model_; }
  const SceneOptions& options() const { return options_; }
  const ArmAddresses& arm() const { return acting().arm; }
  const kinematics::ArmServos& servos() const { return acting().servos; }
  // Returns the greatest torques of the arm's motors, N m. 0 stands for unknown.
  const JointVector& efforts() const { return acting().efforts; }

  // Returns a simulation at the start of the problem: all arms are held at their homes by their
  // servos, grippers are open, and parts are at their initial poses.
  mujoco::Data Start() const;

  // Moves the arm to these joint values (radians) in one jump, for the start of a trial. The arm is
  // at rest and its servos hold it.
  void SetArm(mujoco::Data& data, const JointVector& q) const;
  // Moves the arm to these joint values, and computes the poses of the bodies and nothing else.
  void MoveArm(mujoco::Data& data, const JointVector& q) const;
  // Sets the velocities of the joints, and the rate of the gripper's opening, m/s.
  void SetVelocity(mujoco::Data& data, const JointVector& qd, double opening_rate) const;
  JointVector ArmPosition(const mujoco::Data& data) const;
  JointVector ArmPosition(const mujoco::Data& data, domain::RobotId robot) const;
  JointVector ArmVelocity(const mujoco::Data& data) const;
  Pose ToolPose(const mujoco::Data& data) const;  // X_WorldTool

  // Commands the fingers to close or open together to this opening, metres between the pads. They
  // stop earlier if each pushes with the workcell's grip force. CommandGripper(data, 0) closes on
  // whatever is between the pads.
  void CommandGripper(mujoco::Data& data, double opening) const;
  // Opens the gripper by a length (metres) in one jump, and computes nothing that follows from it.
  void MoveFingers(mujoco::Data& data, double change) const;
  // Sets the gripper to this opening (metres) in one jump, at rest and commanded to stay there.
  void SetGripper(mujoco::Data& data, double opening) const;
  // Makes the contacts of the pads stiffer, to push a part over its support and not to carry it.
  // The friction of the support grows with the part's mass. The usual pads, which depend on the
  // lightest part, would leave a part of 0.7 kg turned by 0.005 degrees.
  void StiffenPads(mujoco::Data& data, PartId part) const;
  void SoftenPads(mujoco::Data& data) const;       // makes them as they usually are
  double Opening(const mujoco::Data& data) const;  // metres between the pads
  double Opening(const mujoco::Data& data, domain::RobotId robot) const;
  double OpeningSpeed(const mujoco::Data& data) const;  // m/s, positive when opening
  double max_opening() const { return acting().max_opening; }

  int part_count() const { return static_cast<int>(parts_.size()); }
  mujoco::BodyId Body(PartId part) const { return parts_[part.index()].body; }
  Pose TruePose(const mujoco::Data& data, PartId part) const;  // X_WorldPart
  double TrueMass(PartId part) const;                          // kg
  Twist TrueTwist(const mujoco::Data& data, PartId part) const;
  // Returns the twist of a body at a point (world frame) that moves with the hand.
  Twist TwistWithHand(const mujoco::Data& data, const Vector3& p_World) const;
  ArmPosture Posture(const mujoco::Data& data, domain::RobotId robot) const;
  // Moves all arms (by RobotId) and all parts (by PartId) in one jump, and computes the poses of
  // the bodies. It is for pictures. Data::Forward must be called before the simulation goes on.
  void Show(mujoco::Data& data, const std::vector<ArmPosture>& arms,
            const std::vector<Pose>& X_WorldPart) const;

  // Set the pose and the twist of a part, and nothing that follows from them.
  void MovePart(mujoco::Data& data, PartId part, const Pose& X_WorldPart) const;
  void SetPartTwist(mujoco::Data& data, PartId part, const Twist& twist) const;
  // Moves a part to a pose in one jump, at rest, for the start of a trial.
  void SetPart(mujoco::Data& data, PartId part, const Pose& X_WorldPart) const;

  // Clamps the part: from now on a force (newtons) presses it down, so that it keeps its place on
  // the table.
  void Clamp(mujoco::Data& data, PartId part, double force) const;

  // Raise the tables by a height, metres, under one part or under the hand. The caller must also
  // raise whatever rests there.
  void SetTableHeight(mujoco::Data& data, PartId part, double height) const;
  double TableHeight(const mujoco::Data& data, PartId part) const;
  void SetTableHeightUnderHand(mujoco::Data& data, double height) const;

  // Fixes the part to the tool at its present pose if the mode is GraspMode::kWeld. Does nothing
  // with kFriction.
  void AttachPart(mujoco::Data& data, PartId part) const;
  void DetachPart(mujoco::Data& data, PartId part) const;
  bool IsAttached(const mujoco::Data& data, PartId part) const;  // whether it is fixed to the tool

  // Returns the wrench that contacts and welds exert on hand, fingers and held part, about the
  // origin of the wrist site (the flange), world frame. It is the reading of the force and torque
  // sensor without the weight of hand and fingers. It is quasi-static: the inertial forces of hand
  // and fingers stay in it.
  Wrench WristWrench(const mujoco::Data& data) const;
  // Returns the wrench of WristWrench without the inertial force of hand and fingers, which an
  // accelerometer in the hand can measure. Their inertial torque is small and stays in it.
  Wrench WristWrenchInMotion(const mujoco::Data& data) const;
  // Returns the acceleration of the centre of mass of hand and fingers, world frame, m/s^2.
  Vector3 HandAcceleration(const mujoco::Data& data) const;

  // The bodies between which contacts can be queried (mujoco::ContactsBetween). Table and floor
  // belong to the world.
  mujoco::BodyId world() const { return mujoco::BodyId(0); }
  mujoco::BodyId hand() const { return acting().hand; }
  mujoco::BodyId left_finger() const { return acting().fingers[0].body; }
  mujoco::BodyId right_finger() const { return acting().fingers[1].body; }
  bool Touching(const mujoco::Data& data, PartId part, mujoco::BodyId body) const;
  BodyKind KindOf(mujoco::BodyId body) const;

 private:
  struct FreeBody {
    mujoco::BodyId body;
    int qpos = 0;  // index of the position, followed by the quaternion w x y z
    // Index of the linear velocity (world frame), followed by the angular velocity (body frame).
    int dof = 0;
    std::vector<mujoco::EqualityId> welds;  // one to each robot's hand, or none at all
    std::vector<mujoco::GeomId> tables;
  };
  struct Finger {
    mujoco::BodyId body;
    int qpos = 0;
    int dof = 0;
    int ctrl = 0;
  };
  struct RobotAddresses {
    ArmAddresses arm;
    std::array<Finger, 2> fingers;
    mujoco::BodyId hand;
    mujoco::SiteId tool;
    mujoco::SiteId wrist;
    int force_sensor = 0;   // index in sensordata
    int torque_sensor = 0;  // index in sensordata
    double max_opening = 0;
    kinematics::ArmServos servos;
    JointVector efforts = JointVector::Zero();
    JointVector home = JointVector::Zero();
  };

  const RobotAddresses& acting() const { return robots_[acting_.index()]; }
  std::vector<mujoco::GeomId> Pads() const;  // of the acting hand
  Vector3 WeldTorqueError(const mujoco::Data& data) const;
  mujoco::EqualityId WeldOf(PartId part) const;  // the weld to the acting hand; None without welds
  RobotAddresses FindRobot(const domain::Robot& robot) const;
  Finger FindFinger(const std::string& name) const;
  FreeBody FindPart(const std::string& name, const domain::Workcell& workcell) const;
  void SetTableHeights(mujoco::Data& data, const std::vector<mujoco::GeomId>& tables,
                       double height) const;

  SceneOptions options_;
  mujoco::Model model_;
  std::vector<RobotAddresses> robots_;
  domain::RobotId acting_;
  std::vector<FreeBody> parts_;
  std::vector<mujoco::GeomId> tables_;
  // The height of each table's origin when its top is at height 0.
  std::vector<double> table_middles_;
};

}  // namespace assay::scene
