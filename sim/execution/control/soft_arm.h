#pragma once

#include <optional>

#include "sim/execution/control/control_law.h"
#include "sim/execution/robots/execution.h"

namespace assay::execution {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

Vector6 Joined(const Vector3& a, const Vector3& b);
// Returns the twist from one pose to another, about the origin of the first: metres, radians.
Vector6 TwistBetween(const Pose& from, const Pose& to);

// The commanded motion of the tip, as twists in metres and radians per second: the planned motion,
// which the arm follows without lag, and the yielding to forces.
struct TipMotion {
  Vector6 planned = Vector6::Zero();
  Vector6 yielding = Vector6::Zero();
};

// The arm with soft servos and a part in its hand, treated as the tip of that part: it moves by
// twists and feels wrenches. All twists, wrenches and poses are about the tip and in the fixed
// part's axes.
class SoftArm {
 public:
  // The part is that in the execution's hand, seen from `fixed`. All arguments must outlive this
  // object.
  SoftArm(Execution& execution, PartId fixed, const Pose& X_HeldTip, const ControlLaw& law);

  const mujoco::Data& data() const { return execution_.data(); }
  // Executes one timestep, or a few milliseconds without dynamics if the tip touches nothing.
  Progress Step(const TipMotion& motion);
  // Returns how long the last step took, and how long the next one may take, in seconds.
  double period() const { return period_; }
  double NextPeriod() const;

  // Returns the wrench of the contacts on the held part: that at the wrist without the part's
  // weight.
  const Vector6& wrench() const { return wrench_; }
  const TipMotion& velocity() const { return velocity_; }
  // Returns the compliance of the soft arm: m/N, rad/(N m).
  const Matrix6& compliance() const { return compliance_; }
  // Returns the tip's pose from the measured joint values, if the tip is in the hand as believed.
  // Soft servos lag behind their commands.
  Pose MeasuredTip() const;

  // Corrects the believed pose: the tip is displaced by `change` from where it is measured. Later
  // turns are about the corrected point.
  void Correct(const Vector6& change);
  // Returns the believed pose of the tool in the tip's frame.
  const Pose& X_TipTool() const { return X_TipTool_; }
  void Believe(const Pose& X_TipTool);
  // Sets the commanded pose to the tip's measured pose.
  void TakeStock();
  // Computes Jacobian and compliance of the arm for its present pose.
  void Linearize();

 private:
  // Returns the commanded pose of the tip after a time of this twist, seconds.
  Pose After(double seconds, const Vector6& twist) const;
  // Returns joint values that are near the commanded ones, or none.
  std::optional<JointVector> JointsFor(const Pose& X_FixedTip) const;
  // Returns the velocity after a time in which it follows this motion, seconds.
  TipMotion Filtered(const TipMotion& motion, double seconds) const;
  // Moves without dynamics. Returns false if that is not possible.
  bool Glide(const TipMotion& motion);
  void Feel();

  Execution& execution_;
  const ControlLaw& law_;
  Pose X_WorldFixed_;
  Pose X_TipTool_;   // believed pose of the tool in the tip's frame
  Pose X_FixedTip_;  // commanded pose of the tip
  kinematics::Indicators configuration_;
  Eigen::PartialPivLU<Matrix6> jacobian_;  // maps joint rates to the tip's twist
  Matrix6 compliance_ = Matrix6::Zero();
  TipMotion velocity_;
  double period_ = 0;
  Vector6 wrench_ = Vector6::Zero();
};

}  // namespace assay::execution
