#pragma once

#include <optional>

#include "planner/kinematics/arm_solver.h"
#include "planner/kinematics/inverse/chain_inverse.h"

namespace assay::kinematics {

// Any arm with six revolute joints, with indicators for its solutions.
//
// The determinant of the Jacobian has three factors if
// - axes 2 and 3 are parallel, or axes 1 and 2 meet in a point o, and the last three axes meet, or
// - axes 2, 3 and 4 are parallel, and axes 5 and 6 meet.
// Let n be the direction of axis 2, and c the point in which the last axes meet.
// - Shoulder: the velocity of c by joint 1, along n. If axes 2 and 3 are parallel, c is on a given
//   distance along n from axis 2 for two values of q1. If axes 1 and 2 meet, two turns about them
//   lead a point at the right distance from o to c. The velocity has opposite signs in these two.
// - Elbow: if axes 2 and 3 are parallel, the levers of these axes to c, or to axis 4, span this
// area
//   about n. Two links in a plane reach a point in two ways, whose areas have opposite signs. If
//   axes 1 and 2 meet, the velocity of c by joint 3 away from o takes the place of the area. The
//   distance of c from o has a given value for two values of q3, and this velocity is its
//   derivative.
// - Wrist: the volume that the last three axes span, or n and the last two axes.
// The signs of the three factors tell all solutions of a regular pose apart. As with Lee and
// Ziegler, Elbow is the product of two signs: that of its own factor and that of Shoulder's.
//
// An arm also has these factors if they exist when its axes are counted from the flange to the
// base. The base then moves in the flange's frame, and the postures of a pose are the same.
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
  bool TellsAllApart() const override { return factors_.has_value(); }
  bool HasSphericalWrist() const override { return has_spherical_wrist_; }
  Vector3 p_FlangeCenter() const override { return p_FlangeCenter_; }
  ArmJacobian JacobianAt(const JointVector& q) const override;

 private:
  // How the axes lie of an arm whose determinant has factors.
  struct Factors {
    bool from_flange = false;   // the axes are counted from the flange to the base
    bool is_spherical = false;  // the last three axes meet, not just the last two
    // The point in which the last axes meet, in the frame that they move: the flange, or the base
    // if the axes are counted from the flange.
    Vector3 c = Vector3::Zero();
    // The point in which axes 1 and 2 meet, in the other frame. Nothing if axes 2 and 3 are
    // parallel.
    std::optional<Vector3> o = {};
  };
  static std::optional<Factors> FactorsOf(const SerialChain& chain, bool from_flange);

  ChainInverse inverse_;
  bool has_spherical_wrist_ = false;
  Vector3 p_FlangeCenter_ = Vector3::Zero();
  std::optional<Factors> factors_;
};

}  // namespace assay::kinematics
