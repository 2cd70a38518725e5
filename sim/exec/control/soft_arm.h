#pragma once

#include <optional>

#include "sim/exec/control/control_law.h"
#include "sim/exec/execution/execution.h"

namespace assay::exec {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Vector6 Joined(const Vector3& a, const Vector3& b);
// The twist from one pose to another, about the first one's origin: metres, radians.
Vector6 TwistBetween(const Pose& from, const Pose& to);

// What the tip is told, as twists in metres and radians a second: what is planned, which the arm
// follows without lag, and what forces ask for.
struct TipMotion {
  Vector6 planned = Vector6::Zero();
  Vector6 yielding = Vector6::Zero();
};

// The arm with soft servos and a part in its hand, as the tip of the part that is mated with
// another: it is moved by twists and feels wrenches. All twists, wrenches and poses are about the
// tip and in the fixed part's axes.
class SoftArm {
 public:
  // The part in the execution's hand, seen from `fixed`. All must outlive this.
  SoftArm(Execution& execution, PartId fixed, const Pose& X_HeldTip, const ControlLaw& law);

  double timestep() const { return execution_.data().timestep(); }
  const mujoco::Data& data() const { return execution_.data(); }
  // One timestep.
  Progress Step(const TipMotion& motion);

  // Of the contacts on the held part: what the wrist feels, without the part's weight.
  const Vector6& wrench() const { return wrench_; }
  const TipMotion& velocity() const { return velocity_; }
  // Of the arm as soft as it is: m/N, rad/(N m).
  const Matrix6& compliance() const { return compliance_; }
  // Where the tip is, if it is in the hand as believed: soft servos lag behind what they are told.
  Pose MeasuredTip() const;

  // The tip is not where it is measured, but displaced by so much from there. Turns are about that
  // point from now on.
  void Correct(const Vector6& change);
  // Where the tip is in the hand, as believed: the tool seen from it.
  const Pose& X_TipTool() const { return X_TipTool_; }
  void Believe(const Pose& X_TipTool);
  // The commanded position is now where the tip is.
  void TakeStock();
  // Jacobian and compliance are those of the arm as it stands now.
  void Linearize();

 private:
  std::optional<JointVector> JointsFor(const Pose& X_WorldTool) const;
  void Feel();

  Execution& execution_;
  const ControlLaw& law_;
  Pose X_WorldFixed_;
  Pose X_TipTool_;   // as believed
  Pose X_FixedTip_;  // commanded
  kinematics::Indicators configuration_;
  Eigen::PartialPivLU<Matrix6> jacobian_;  // of the twist by joint rates
  Matrix6 compliance_ = Matrix6::Zero();
  TipMotion velocity_;
  Vector6 wrench_ = Vector6::Zero();
};

}  // namespace assay::exec
