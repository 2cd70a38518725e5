#include "sim/scene/scene.h"

#include <mujoco/mujoco.h>

#include <algorithm>

#include "planner/base/check.h"
#include "sim/scene/stage_mjcf.h"

namespace assay::scene {
namespace {

using mujoco::Data;
using mujoco::Model;

ArmAddresses FindArm(const Model& model, const domain::Robot& robot) {
  ArmAddresses arm;
  for (std::size_t i = 0; i < arm.qpos.size(); ++i) {
    const std::string name = robot.Prefix() + "arm/" + robot.arm->model().joints[i].name;
    arm.qpos[i] = model.QposAddress(model.Joint(name));
    arm.dof[i] = model.DofAddress(model.Joint(name));
    arm.ctrl[i] = model.Actuator(name).index();
  }
  return arm;
}

JointVector EffortsOf(const kinematics::Arm& arm) {
  JointVector efforts;
  for (std::size_t i = 0; i < 6; ++i) {
    efforts[static_cast<Eigen::Index>(i)] = arm.limits()[i].effort;
  }
  return efforts;
}

JointVector Gather(std::span<const double> values, const std::array<int, 6>& addresses) {
  JointVector gathered;
  for (std::size_t i = 0; i < addresses.size(); ++i) gathered[i] = values[addresses[i]];
  return gathered;
}

void Scatter(const JointVector& from, const std::array<int, 6>& addresses,
             std::span<double> values) {
  for (std::size_t i = 0; i < addresses.size(); ++i) values[addresses[i]] = from[i];
}

void Scatter(const Pose& pose, int address, std::span<double> values) {
  const Eigen::Quaterniond turn(pose.linear());
  const Vector3 p = pose.translation();
  const std::array<double, 7> numbers = {p.x(),    p.y(),    p.z(),   turn.w(),
                                         turn.x(), turn.y(), turn.z()};
  std::copy(numbers.begin(), numbers.end(), values.begin() + address);
}

Vector3 VectorAt(std::span<const double> values, int address) {
  return {values[address], values[address + 1], values[address + 2]};
}

}  // namespace

Scene::Scene(const domain::Problem& problem, const SceneOptions& options)
    : options_(options),
      model_(Model::FromMjcf(ToMjcf(problem, options))),
      acting_(problem.workcell->acting()) {
  for (const domain::Table& table : problem.workcell->tables()) {
    tables_.push_back(model_.Geom(TableGeom(table)));
    table_middles_.push_back(-table.thickness / 2);
  }
  for (const domain::Robot& robot : problem.workcell->robots()) {
    robots_.push_back(FindRobot(robot));
  }
  for (const domain::Part& part : problem.parts) {
    parts_.push_back(FindPart(part.name, *problem.workcell));
  }
}

Scene Scene::WorkedBy(domain::RobotId robot) const {
  ASSAY_CHECK(robot.index() >= 0 && robot.index() < static_cast<int>(robots_.size()));
  Scene other = *this;
  other.acting_ = robot;
  return other;
}

Scene::RobotAddresses Scene::FindRobot(const domain::Robot& robot) const {
  const std::string prefix = robot.Prefix();
  const std::string wrist = prefix + "wrist";
  return {.arm = FindArm(model_, robot),
          .fingers = {FindFinger(prefix + "gripper/finger_left"),
                      FindFinger(prefix + "gripper/finger_right")},
          .hand = model_.Body(prefix + "gripper/hand"),
          .tool = model_.Site(prefix + "tool"),
          .wrist = model_.Site(wrist),
          .force_sensor = model_.SensorAddress(model_.Sensor(wrist + "/force")),
          .torque_sensor = model_.SensorAddress(model_.Sensor(wrist + "/torque")),
          .max_opening = robot.gripper->max_opening(),
          .servos = robot.servos,
          .efforts = EffortsOf(*robot.arm),
          .home = robot.home};
}

Scene::Finger Scene::FindFinger(const std::string& name) const {
  const mujoco::JointId joint = model_.Joint(name);
  return {.body = model_.Body(name),
          .qpos = model_.QposAddress(joint),
          .dof = model_.DofAddress(joint),
          .ctrl = model_.Actuator(name).index()};
}

Scene::FreeBody Scene::FindPart(const std::string& name, const domain::Workcell& workcell) const {
  const mujoco::JointId joint = model_.Joint("part/" + name);
  FreeBody part{.body = model_.Body("part/" + name),
                .qpos = model_.QposAddress(joint),
                .dof = model_.DofAddress(joint),
                .welds = {},
                .tables = {}};
  for (const domain::Table& table : workcell.tables()) {
    part.tables.push_back(model_.Geom(TableGeom(table, name)));
  }
  if (options_.grasp != GraspMode::kWeld) return part;
  for (const domain::Robot& robot : workcell.robots()) {
    part.welds.push_back(model_.Equality(robot.Prefix() + "weld/" + name));
  }
  return part;
}

Data Scene::Start() const {
  Data data(model_);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const Scene scene = WorkedBy(domain::RobotId(i));
    scene.SetArm(data, robots_[i].home);
    scene.SetGripper(data, robots_[i].max_opening);
  }
  return data;
}

void Scene::SetArm(Data& data, const JointVector& q) const {
  Scatter(q, arm().qpos, data.qpos());
  Scatter(JointVector::Zero(), arm().dof, data.qvel());
  Scatter(q, arm().ctrl, data.ctrl());
  data.Forward();
  Scatter(Gather(data.qfrc_bias(), arm().dof), arm().dof, data.qfrc_applied());
}

void Scene::MoveArm(Data& data, const JointVector& q) const {
  Scatter(q, arm().qpos, data.qpos());
  data.MoveBodies();
}

void Scene::SetVelocity(Data& data, const JointVector& qd, double opening_rate) const {
  Scatter(qd, arm().dof, data.qvel());
  for (const Finger& finger : acting().fingers) data.qvel()[finger.dof] = opening_rate / 2;
}

JointVector Scene::ArmPosition(const Data& data) const { return ArmPosition(data, acting_); }

JointVector Scene::ArmPosition(const Data& data, domain::RobotId robot) const {
  return Gather(data.qpos(), robots_[robot.index()].arm.qpos);
}

JointVector Scene::ArmVelocity(const Data& data) const { return Gather(data.qvel(), arm().dof); }

Pose Scene::ToolPose(const Data& data) const { return data.SitePose(acting().tool); }

void Scene::CommandGripper(Data& data, double opening) const {
  const double half = std::clamp(opening, 0.0, max_opening()) / 2;
  for (const Finger& finger : acting().fingers) data.ctrl()[finger.ctrl] = half;
}

void Scene::MoveFingers(Data& data, double change) const {
  for (const Finger& finger : acting().fingers) data.qpos()[finger.qpos] += change / 2;
}

void Scene::SetGripper(Data& data, double opening) const {
  CommandGripper(data, opening);
  for (const Finger& finger : acting().fingers) {
    data.qpos()[finger.qpos] = data.ctrl()[finger.ctrl];
    data.qvel()[finger.dof] = 0;
  }
  data.Forward();
}

double Scene::Opening(const Data& data) const { return Opening(data, acting_); }

double Scene::Opening(const Data& data, domain::RobotId robot) const {
  const std::array<Finger, 2>& fingers = robots_[robot.index()].fingers;
  return data.qpos()[fingers[0].qpos] + data.qpos()[fingers[1].qpos];
}

double Scene::OpeningSpeed(const Data& data) const {
  return data.qvel()[acting().fingers[0].dof] + data.qvel()[acting().fingers[1].dof];
}

Pose Scene::TruePose(const Data& data, PartId part) const { return data.BodyPose(Body(part)); }

double Scene::TrueMass(PartId part) const { return model_.get()->body_mass[Body(part).index()]; }

Twist Scene::TrueTwist(const Data& data, PartId part) const {
  const int dof = parts_[part.index()].dof;
  const Vector3 angular_in_body = VectorAt(data.qvel(), dof + 3);
  return {.linear = VectorAt(data.qvel(), dof),
          .angular = TruePose(data, part).linear() * angular_in_body};
}

Twist Scene::TwistWithHand(const Data& data, const Vector3& p_World) const {
  const mjModel& m = *data.own_model();
  using Jacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
  Jacobian linear(3, m.nv);
  Jacobian angular(3, m.nv);
  mj_jac(&m, data.get(), linear.data(), angular.data(), p_World.data(), hand().index());
  const Eigen::Map<const Eigen::VectorXd> qvel(data.get()->qvel, m.nv);
  return {.linear = linear * qvel, .angular = angular * qvel};
}

void Scene::SetPartTwist(Data& data, PartId part, const Twist& twist) const {
  const auto at = data.qvel().begin() + parts_[part.index()].dof;
  const Vector3 angular_in_body = TruePose(data, part).linear().transpose() * twist.angular;
  std::copy_n(twist.linear.data(), 3, at);
  std::copy_n(angular_in_body.data(), 3, at + 3);
}

ArmPosture Scene::Posture(const Data& data, domain::RobotId robot) const {
  return {ArmPosition(data, robot), Opening(data, robot)};
}

void Scene::Show(Data& data, const std::vector<ArmPosture>& arms,
                 const std::vector<Pose>& X_WorldPart) const {
  for (std::size_t i = 0; i < arms.size(); ++i) {
    Scatter(arms[i].q, robots_[i].arm.qpos, data.qpos());
    for (const Finger& finger : robots_[i].fingers) {
      data.qpos()[finger.qpos] = arms[i].opening / 2;
    }
  }
  for (std::size_t i = 0; i < X_WorldPart.size(); ++i) {
    Scatter(X_WorldPart[i], parts_[i].qpos, data.qpos());
  }
  data.MoveBodies();
}

void Scene::MovePart(Data& data, PartId part, const Pose& X_WorldPart) const {
  Scatter(X_WorldPart, parts_[part.index()].qpos, data.qpos());
}

void Scene::SetPart(Data& data, PartId part, const Pose& X_WorldPart) const {
  MovePart(data, part, X_WorldPart);
  SetPartTwist(data, part, {});
  data.Forward();
}

void Scene::Clamp(Data& data, PartId part, double force) const {
  data.get()->xfrc_applied[6 * Body(part).index() + 2] = -force;
}

void Scene::SetTableHeights(Data& data, const std::vector<mujoco::GeomId>& tables,
                            double height) const {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    data.SetGeomHeight(tables[i], table_middles_[i] + height);
  }
}

void Scene::SetTableHeight(Data& data, PartId part, double height) const {
  SetTableHeights(data, parts_[part.index()].tables, height);
}

double Scene::TableHeight(const Data& data, PartId part) const {
  return data.GeomHeight(parts_[part.index()].tables.front()) - table_middles_.front();
}

void Scene::SetTableHeightUnderHand(Data& data, double height) const {
  SetTableHeights(data, tables_, height);
}

// Only pads have a priority among the geoms of fingers (robot_mjcf.cc).
std::vector<mujoco::GeomId> Scene::Pads() const {
  const mjModel& m = *model_.get();
  std::vector<mujoco::GeomId> pads;
  for (int geom = 0; geom < m.ngeom; ++geom) {
    const mujoco::BodyId body(m.geom_bodyid[geom]);
    if ((body == left_finger() || body == right_finger()) && m.geom_priority[geom] > 0)
      pads.emplace_back(geom);
  }
  return pads;
}

void Scene::StiffenPads(Data& data, PartId part) const {
  constexpr double kSoftnessPerMass = 0.0005;  // 1/kg
  constexpr double kLeastSoftness = 0.0001;    // of the engine
  const double softness =
      std::max(kLeastSoftness, kSoftnessPerMass * model_.get()->body_mass[Body(part).index()]);
  for (const mujoco::GeomId pad : Pads()) {
    const double usual = 1 - model_.get()->geom_solimp[mjNIMP * pad.index()];
    data.SetImpedance(pad, 1 - std::min(usual, softness));
  }
}

void Scene::SoftenPads(Data& data) const {
  for (const mujoco::GeomId pad : Pads())
    data.SetImpedance(pad, model_.get()->geom_solimp[mjNIMP * pad.index()]);
}

mujoco::EqualityId Scene::WeldOf(PartId part) const {
  const std::vector<mujoco::EqualityId>& welds = parts_[part.index()].welds;
  return welds.empty() ? mujoco::EqualityId::None() : welds[acting_.index()];
}

void Scene::AttachPart(Data& data, PartId part) const {
  if (!WeldOf(part).IsNone()) data.ActivateWeldHere(WeldOf(part));
}

void Scene::DetachPart(Data& data, PartId part) const {
  if (!WeldOf(part).IsNone()) data.Deactivate(WeldOf(part));
}

bool Scene::IsAttached(const Data& data, PartId part) const {
  return !WeldOf(part).IsNone() && data.IsActive(WeldOf(part));
}

// The sensors measure what the arm exerts on the hand, in the site's frame. At rest this wrench,
// gravity and the contacts' wrench add up to zero: contacts = -(sensor) - m g.
Wrench Scene::WristWrench(const Data& data) const {
  const Pose X_WorldWrist = data.SitePose(acting().wrist);
  const mjModel& m = *data.own_model();
  const Vector3 weight =
      m.body_subtreemass[hand().index()] * Eigen::Map<const Vector3>(m.opt.gravity);
  const Eigen::Map<const Vector3> center(data.get()->subtree_com + 3 * hand().index());
  const Vector3 arm = center - X_WorldWrist.translation();
  const Vector3 force = X_WorldWrist.linear() * VectorAt(data.sensordata(), acting().force_sensor);
  const Vector3 torque =
      X_WorldWrist.linear() * VectorAt(data.sensordata(), acting().torque_sensor);
  return {.force = -force - weight, .torque = -torque - arm.cross(weight) + WeldTorqueError(data)};
}

// Returns the error of the engine's torque sensor for a weld. The sensor takes the forces of the
// weld's three angular rows for the torque. However, these rows are in half quaternions, so the
// true torque is the product of their transposed Jacobian and the forces. The weld's other rows
// exert no torque, because the weld is at the part's origin.
Vector3 Scene::WeldTorqueError(const Data& data) const {
  const mjModel& m = *data.own_model();
  const mjData& d = *data.get();
  Vector3 error = Vector3::Zero();
  for (int row = 0; row < d.ne; ++row) {
    const auto part = std::ranges::find_if(parts_, [&](const FreeBody& body) {
      return !body.welds.empty() && body.welds[acting_.index()].index() == d.efc_id[row];
    });
    if (part == parts_.end()) continue;
    std::vector<double> turning(d.nefc);
    std::copy_n(d.efc_force + row + 3, 3, turning.begin() + row + 3);
    std::vector<double> on_part(m.nv);
    mj_mulJacTVec(&m, const_cast<mjData*>(&d), on_part.data(), turning.data());  // only reads d
    error -= data.BodyPose(part->body).linear() * VectorAt(on_part, part->dof + 3);
    error -= Eigen::Map<const Vector3>(d.efc_force + row + 3);
    row += 5;
  }
  return error;
}

Wrench Scene::WristWrenchInMotion(const Data& data) const {
  const Eigen::Map<const Vector3> center(data.get()->subtree_com + 3 * hand().index());
  const Vector3 arm = center - data.SitePose(acting().wrist).translation();
  const Vector3 inertial =
      data.own_model()->body_subtreemass[hand().index()] * HandAcceleration(data);
  const Wrench wrist = WristWrench(data);
  return {.force = wrist.force + inertial, .torque = wrist.torque + arm.cross(inertial)};
}

// The engine's accelerations are those that an accelerometer feels: gravity counts as an
// acceleration upward.
Vector3 Scene::HandAcceleration(const Data& data) const {
  const mjModel& m = *data.own_model();
  mjtNum felt[6];  // angular, then linear, at the body's centre of mass
  mj_objectAcceleration(&m, data.get(), mjOBJ_BODY, hand().index(), felt, 0);
  const Eigen::Map<const Vector3> angular(felt);
  const Eigen::Map<const Vector3> linear(felt + 3);
  const Eigen::Map<const Vector3> center(data.get()->subtree_com + 3 * hand().index());
  const Eigen::Map<const Vector3> own(data.get()->xipos + 3 * hand().index());
  return linear + angular.cross(center - own) + Eigen::Map<const Vector3>(m.opt.gravity);
}

BodyKind Scene::KindOf(mujoco::BodyId body) const {
  if (body == world()) return BodyKind::kWorld;
  if (std::ranges::count(parts_, body, &FreeBody::body) > 0) return BodyKind::kPart;
  const bool is_hand = std::ranges::any_of(robots_, [&](const RobotAddresses& robot) {
    return body == robot.hand || std::ranges::count(robot.fingers, body, &Finger::body) > 0;
  });
  return is_hand ? BodyKind::kHand : BodyKind::kArm;
}

bool Scene::Touching(const Data& data, PartId part, mujoco::BodyId body) const {
  return !mujoco::ContactsBetween(data, Body(part), body).empty();
}

}  // namespace assay::scene
