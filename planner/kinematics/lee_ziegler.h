#pragma once

#include "planner/kinematics/arm_geometry.h"
#include "planner/kinematics/arm_solver.h"

namespace assay::kinematics {

// The closed form for arms like the Puma robots (Lee and Ziegler 1983), whose shoulder and elbow
// axes are parallel and whose wrist is spherical. Their convention of joint values is used.
//
// The indicators are the paper's. ARM = sign(-(d4 s23 + a3 c23 + a2 c2)): the wrist is behind (+1)
// or before (-1) axis 1. ELBOW = ARM sign(d4 c3 - a3 s3). sign(0) is +1. The wrist's indicator is
// the paper's FLIP toggle as a property of the joint values: sin(q5) >= 0 (kNoFlip) or < 0 (kFlip).
// The paper's indicator WRIST is different: it compares the hand with axis 5, and depends on how
// the hand is mounted.
//
// A pose has eight solutions inside the reach and none outside. Singular poses are special:
// - Shoulder (the wrist centre is at its least distance from axis 1): the two shoulder solutions
//   coincide and are given once, as kRight. Without an offset d2, q1 is free and is taken from the
//   reference.
// - Elbow (the arm is stretched or folded): the two elbow solutions coincide and are given once.
// - Wrist (axes 4 and 6 are in line): q4 is free. kNoFlip takes q4 of the reference, and kFlip
//   takes that plus pi. q6 follows from the pose.
// - Wrist centre on axis 2 (only if the upper arm is as long as the forearm): q2 is free and is
//   taken from the reference.
// A pose counts as singular if the quantity that vanishes at such poses (a distance in metres, or
// the sine of q5) is below 1e-10. Every solution therefore reproduces the pose to better than 1e-9.
// Solutions that coincide only up to rounding are all given.
class LeeZiegler : public ArmSolver {
 public:
  explicit LeeZiegler(const ArmGeometry& geometry) : g_(geometry) {}

  Pose Forward(const JointVector& q) const override;
  InverseSolutions Inverse(const Pose& X_BaseFlange, const JointVector& reference) const override;
  std::optional<JointVector> Inverse(const Pose& X_BaseFlange, const Indicators& indicators,
                                     const JointVector& reference) const override;
  Indicators IndicatorsOf(const JointVector& q) const override;
  bool TellsAllApart() const override { return true; }
  bool HasSphericalWrist() const override { return true; }
  Vector3 p_FlangeCenter() const override { return {0, 0, -g_.d6}; }
  ArmJacobian JacobianAt(const JointVector& q) const override;

 private:
  ArmGeometry g_;
};

}  // namespace assay::kinematics
