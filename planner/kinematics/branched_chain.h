#pragma once

#include "planner/kinematics/arm_solver.h"
#include "planner/kinematics/inverse/chain_inverse.h"

namespace assay::kinematics {

// Any arm with six revolute joints, with indicators for its solutions.
//
// If axes 2 and 3 are parallel and either the last three axes meet, or axis 4 is parallel, too, and
// axes 5 and 6 meet, then the determinant of the Jacobian has three factors. Let n be the direction
// of axis 2, and c the point in which the last axes meet.
// - Shoulder: the velocity of c by joint 1, along n. c is on a given distance along n from axis 2
//   for two values of q1, and this velocity is the derivative of the distance.
// - Elbow: the levers of axes 2 and 3 to c, or to axis 4, span this area about n. Two links in a
//   plane reach a point in two ways, whose areas have opposite signs.
// - Wrist: the volume that the last three axes span, or n and the last two axes.
// The signs of the three factors tell all solutions of a regular pose apart. As with Lee and
// Ziegler, Elbow is the product of two signs: that of its own factor and that of Shoulder's.
//
// The determinants of other arms need not have factors. Their indicator Wrist is the sign of the
// determinant, and the other two do not change.
class BranchedChain : public ArmSolver {
 public:
  // The chain must have six joints, and its flange must be able to move in all directions.
  explicit BranchedChain(SerialChain chain);

  Pose Forward(const JointVector& q) const override { return inverse_.chain().Forward(q); }
  InverseSolutions Inverse(const Pose& X_BaseFlange, const JointVector& reference) const override;
  std::optional<JointVector> Inverse(const Pose& X_BaseFlange, const Indicators& indicators,
                                     const JointVector& reference) const override;
  Indicators IndicatorsOf(const JointVector& q) const override;
  bool TellsAllApart() const override { return has_factors_; }
  bool HasSphericalWrist() const override { return has_spherical_wrist_; }
  Vector3 p_FlangeCenter() const override { return p_FlangeCenter_; }
  ArmJacobian JacobianAt(const JointVector& q) const override;

 private:
  ArmJacobian JacobianAbout(const Vector3& p_Flange, const JointVector& q) const;

  ChainInverse inverse_;
  bool has_spherical_wrist_ = false;
  bool has_factors_ = false;
  Vector3 p_FlangeCenter_ = Vector3::Zero();
  Vector3 p_FlangeLast_ = Vector3::Zero();  // the point in which the last axes meet
};

}  // namespace assay::kinematics
