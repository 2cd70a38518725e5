#include "sim/execution/control/soft_arm.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/solids/mass_properties.h"
#include "sim/execution/control/straight_line.h"

namespace assay::execution {
namespace {

constexpr double kGreatestTurn = 0.05;  // radians that a joint may turn in one step
// The longest motion without dynamics, seconds. Meanwhile control does nothing.
constexpr double kLongestGlide = 0.004;

Vector3 RotationVector(const geometry::Matrix3& R) {
  const Eigen::AngleAxisd turn(R);
  return turn.angle() * turn.axis();
}

geometry::Matrix3 Rotation(const Vector3& vector) {
  const double angle = vector.norm();
  if (angle < 1e-15) return geometry::Matrix3::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

}  // namespace

Vector6 Joined(const Vector3& a, const Vector3& b) {
  Vector6 joined;
  joined << a, b;
  return joined;
}

Vector6 TwistBetween(const Pose& from, const Pose& to) {
  return Joined(to.translation() - from.translation(),
                RotationVector(to.linear() * from.linear().transpose()));
}

SoftArm::SoftArm(Execution& execution, PartId fixed, const Pose& X_HeldTip, const ControlLaw& law)
    : execution_(execution),
      law_(law),
      X_WorldFixed_(execution.world().PartPose(fixed)),
      X_TipTool_(X_HeldTip.inverse() * execution.world().hold().X_PartTool),
      X_FixedTip_(X_WorldFixed_.inverse() * execution.BelievedTool() * X_TipTool_.inverse()),
      configuration_(execution.problem().workcell->arm().IndicatorsOf(execution.commanded())),
      period_(execution.data().timestep()) {
  execution.ForgetKinematics();
  Linearize();
}

Pose SoftArm::After(double seconds, const Vector6& twist) const {
  Pose X_FixedTip = X_FixedTip_;
  X_FixedTip.translation() += seconds * twist.head<3>();
  X_FixedTip.linear() = Rotation(seconds * twist.tail<3>()) * X_FixedTip.linear();
  return X_FixedTip;
}

Progress SoftArm::Step(const TipMotion& motion) {
  if (Glide(motion)) return std::nullopt;
  const double dt = execution_.data().timestep();
  const Vector6 acceleration = (motion.planned - velocity_.planned) / dt;
  velocity_ = Filtered(motion, dt);
  X_FixedTip_ = After(dt, velocity_.planned + velocity_.yielding);
  const auto q = JointsFor(X_FixedTip_);
  if (!q) return Failure{TrialOutcome::kUnreachable, "the arm cannot follow"};
  const JointVector qd = (*q - execution_.commanded()) / dt;
  const JointVector qdd = jacobian_.solve(acceleration);
  if (Progress failure = execution_.StepSoftly({*q, qd}, qdd, law_.softness)) return failure;
  period_ = dt;
  Feel();
  return std::nullopt;
}

double SoftArm::NextPeriod() const {
  const double free = execution_.KinematicUntil() - execution_.data().time();
  return std::max(std::min(kLongestGlide, free), execution_.data().timestep());
}

// Nothing touches the tip, so the wrench decays.
bool SoftArm::Glide(const TipMotion& motion) {
  const double longest = NextPeriod();
  if (longest == execution_.data().timestep()) return false;
  const TipMotion velocity = Filtered(motion, longest);
  const Vector6 twist = velocity.planned + velocity.yielding;
  const auto q = JointsFor(After(longest, twist));
  if (!q) return false;
  const JointVector qd = (*q - execution_.commanded()) / longest;
  const double gone = execution_.GlideSoftly({*q, qd}, longest);
  if (gone == 0) return false;
  X_FixedTip_ = After(gone, twist);
  velocity_ = velocity;
  period_ = gone;
  wrench_ -= std::min(1.0, gone / law_.wrench_filter) * wrench_;
  return true;
}

TipMotion SoftArm::Filtered(const TipMotion& motion, double seconds) const {
  const double share = std::min(1.0, seconds / law_.velocity_filter);
  return {motion.planned, velocity_.yielding + share * (motion.yielding - velocity_.yielding)};
}

Pose SoftArm::MeasuredTip() const {
  return X_WorldFixed_.inverse() * execution_.MeasuredTool() * X_TipTool_.inverse();
}

void SoftArm::Correct(const Vector6& change) {
  Pose X_FixedTip = MeasuredTip();
  X_FixedTip.translation() += change.head<3>();
  X_FixedTip.linear() = Rotation(change.tail<3>()) * X_FixedTip.linear();
  Believe(X_FixedTip.inverse() * X_WorldFixed_.inverse() * execution_.MeasuredTool());
}

void SoftArm::Believe(const Pose& X_TipTool) {
  X_TipTool_ = X_TipTool;
  X_FixedTip_ = X_WorldFixed_.inverse() * execution_.BelievedTool() * X_TipTool_.inverse();
}

void SoftArm::TakeStock() {
  execution_.TakeStock();
  X_FixedTip_ = X_WorldFixed_.inverse() * execution_.BelievedTool() * X_TipTool_.inverse();
  velocity_ = {};
}

// Computes the Jacobian J at the tip by differences, and the compliance J K^-1 J' with the servos'
// stiffness K.
void SoftArm::Linearize() {
  constexpr double kTurn = 1e-5;  // radians of a joint, for differences
  const domain::Workcell& workcell = *execution_.problem().workcell;
  const auto tip_at = [&](const JointVector& q) {
    return X_WorldFixed_.inverse() * ToolAt(workcell, q) * X_TipTool_.inverse();
  };
  const JointVector q = execution_.commanded();
  const Pose X_FixedTip = tip_at(q);
  Matrix6 jacobian;
  Matrix6 flexibility = Matrix6::Zero();
  for (int joint = 0; joint < 6; ++joint) {
    JointVector turned = q;
    turned[joint] += kTurn;
    jacobian.col(joint) = TwistBetween(X_FixedTip, tip_at(turned)) / kTurn;
    flexibility(joint, joint) =
        1 / workcell.robot().servos[static_cast<std::size_t>(joint)].stiffness;
  }
  jacobian_.compute(jacobian);
  compliance_ = jacobian * flexibility * jacobian.transpose() / law_.softness;
}

std::optional<JointVector> SoftArm::JointsFor(const Pose& X_FixedTip) const {
  const Pose X_WorldTool = execution_.Erring(X_WorldFixed_ * X_FixedTip * X_TipTool_);
  const domain::Workcell& workcell = *execution_.problem().workcell;
  const JointVector& now = execution_.commanded();
  for (const auto& s : workcell.arm().Inverse(workcell.FlangeFor(X_WorldTool), now)) {
    if (s.indicators != configuration_) continue;
    const auto q = workcell.arm().NearestInRange(s.q, now);
    if (q && (*q - now).cwiseAbs().maxCoeff() < kGreatestTurn) return q;
  }
  return std::nullopt;
}

void SoftArm::Feel() {
  const scene::Scene& scene = execution_.scene();
  mujoco::Data& data = execution_.data();
  const WorldModel& world = execution_.world();
  const Pose X_WorldTool = scene.ToolPose(data);
  const Pose X_WorldHeld = world.PartPose(world.held(), X_WorldTool);
  const auto& mass = execution_.problem().part(world.held()).model->mass();
  const Vector3 tip = (X_WorldFixed_ * X_FixedTip_).translation();
  const Vector3 load =
      -mass.mass * (scene::kGravity * Vector3::UnitZ() + scene.HandAcceleration(data));
  const scene::Wrench wrist = scene.WristWrenchInMotion(data);
  const Vector3 flange = X_WorldTool *
                         execution_.problem().workcell->gripper().X_FlangeTool().inverse() *
                         Vector3::Zero();
  const Vector3 force = wrist.force - load;
  const Vector3 torque = wrist.torque + (flange - tip).cross(wrist.force) -
                         (X_WorldHeld * mass.center - tip).cross(load);
  const geometry::Matrix3 R = X_WorldFixed_.linear().transpose();
  const double share = std::min(1.0, data.timestep() / law_.wrench_filter);
  wrench_ += share * (Joined(R * force, R * torque) - wrench_);
}

}  // namespace assay::execution
