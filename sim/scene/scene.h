#pragma once

#include <array>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/kinematics/arm.h"
#include "sim/mujoco/contact.h"
#include "sim/mujoco/data.h"
#include "sim/mujoco/model.h"
#include "sim/scene/mjcf.h"

namespace assay::scene {

using domain::PartId;
using geometry::Pose;
using geometry::Vector3;
using kinematics::JointVector;

inline constexpr double kGravity = 9.81;  // m/s^2, the engine's

// A force and a torque about a point, newtons and newton metres.
struct Wrench {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
};

// Velocity of a body's origin and its angular velocity, world frame.
struct Twist {
  Vector3 linear = Vector3::Zero();   // m/s
  Vector3 angular = Vector3::Zero();  // rad/s
};

// What a body of the engine is.
enum class BodyKind {
  kWorld,  // tables and floor
  kPart,
  kArm,   // a link of an arm, its foot included
  kHand,  // hand or finger
};

// Where the engine keeps the six arm joints, joint 1 first.
struct ArmAddresses {
  std::array<int, 6> qpos{};
  std::array<int, 6> dof{};   // in qvel, qfrc_applied, qfrc_bias
  std::array<int, 6> ctrl{};  // position of the joint's servo
};

// The workcell of a problem in the engine, as the robot that acts has it: arm, gripper, hand, tool
// and wrist are that robot's. Immutable: threads may share it, each with its own Data.
class Scene {
 public:
  Scene(const domain::Problem& problem, const SceneOptions& options);
  // The same scene, in which this robot acts: of the same model, so that both work on one Data.
  Scene WorkedBy(domain::RobotId robot) const;

  const mujoco::Model& model() const { return model_; }
  const SceneOptions& options() const { return options_; }
  const ArmAddresses& arm() const { return acting().arm; }

  // A simulation at the problem's start: all arms at their homes, servos holding them there,
  // grippers open, parts at their initial poses.
  mujoco::Data Start() const;

  // The arm, at rest with its servos on these joint values: a jump, for the start of a trial.
  void SetArm(mujoco::Data& data, const JointVector& q) const;
  JointVector ArmPosition(const mujoco::Data& data) const;
  JointVector ArmPosition(const mujoco::Data& data, domain::RobotId robot) const;
  JointVector ArmVelocity(const mujoco::Data& data) const;
  Pose ToolPose(const mujoco::Data& data) const;  // X_WorldTool

  // The fingers close or open together until this opening (metres between the pads) or until each
  // pushes with the workcell's grip force. CommandGripper(data, 0) closes on whatever is there.
  void CommandGripper(mujoco::Data& data, double opening) const;
  // The gripper is set to this opening, at rest and commanded there: a jump.
  void SetGripper(mujoco::Data& data, double opening) const;
  double Opening(const mujoco::Data& data) const;  // metres between the pads
  double Opening(const mujoco::Data& data, domain::RobotId robot) const;
  double OpeningSpeed(const mujoco::Data& data) const;  // m/s, positive when opening
  double max_opening() const { return acting().max_opening; }

  int part_count() const { return static_cast<int>(parts_.size()); }
  mujoco::BodyId Body(PartId part) const { return parts_[part.index()].body; }
  Pose TruePose(const mujoco::Data& data, PartId part) const;  // X_WorldPart
  double TrueMass(PartId part) const;                          // kg
  Twist TrueTwist(const mujoco::Data& data, PartId part) const;
  // Puts a part somewhere, at rest: a jump, for the start of a trial.
  void SetPart(mujoco::Data& data, PartId part, const Pose& X_WorldPart) const;

  // From now on a clamp presses the part down with this force, newtons, so that it stays on the
  // table where it is.
  void Clamp(mujoco::Data& data, PartId part, double force) const;

  // The tables are this much higher, in metres, under one part; and where the hand works. Whatever
  // rests there must be raised with it.
  void SetTableHeight(mujoco::Data& data, PartId part, double height) const;
  double TableHeight(const mujoco::Data& data, PartId part) const;
  void SetTableHeightUnderHand(mujoco::Data& data, double height) const;

  // With GraspMode::kWeld, fixes the part to the tool where it is now; with kFriction, nothing.
  void AttachPart(mujoco::Data& data, PartId part) const;
  void DetachPart(mujoco::Data& data, PartId part) const;

  // What contacts (and welds) exert on hand, fingers and all that they hold, about the wrist
  // site's origin (the flange), world frame. Reading of the force and torque sensor without the
  // weight of hand and fingers; quasi-static: their inertial forces are not taken out.
  Wrench WristWrench(const mujoco::Data& data) const;
  // The same with the inertial force of hand and fingers taken out, as an accelerometer in the hand
  // allows to. What turns them is left in: it is small.
  Wrench WristWrenchInMotion(const mujoco::Data& data) const;
  // Of the hand's and fingers' centre of mass, world frame, m/s^2.
  Vector3 HandAcceleration(const mujoco::Data& data) const;

  // Bodies that contacts are asked about (mujoco::ContactsBetween). Table and floor belong to the
  // world.
  mujoco::BodyId world() const { return mujoco::BodyId(0); }
  mujoco::BodyId hand() const { return acting().hand; }
  mujoco::BodyId left_finger() const { return acting().fingers[0].body; }
  mujoco::BodyId right_finger() const { return acting().fingers[1].body; }
  bool Touching(const mujoco::Data& data, PartId part, mujoco::BodyId body) const;
  BodyKind KindOf(mujoco::BodyId body) const;

 private:
  struct FreeBody {
    mujoco::BodyId body;
    int qpos = 0;  // position, then quaternion w x y z
    int dof = 0;   // linear velocity in the world frame, then angular in the body's
    std::vector<mujoco::EqualityId> welds;  // to each robot's hand, or none
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
    int force_sensor = 0;   // in sensordata
    int torque_sensor = 0;  // in sensordata
    double max_opening = 0;
    JointVector home = JointVector::Zero();
  };

  const RobotAddresses& acting() const { return robots_[acting_.index()]; }
  Vector3 WeldTorqueError(const mujoco::Data& data) const;
  mujoco::EqualityId WeldOf(PartId part) const;  // to the hand; None without welds
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
  std::vector<double> table_middles_;  // the height of a table's origin where its top is at 0
};

}  // namespace assay::scene
