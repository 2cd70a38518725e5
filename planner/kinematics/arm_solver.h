#pragma once

#include <optional>

#include "planner/kinematics/arm_solutions.h"

namespace assay::kinematics {

using geometry::Pose;
using geometry::Vector3;

// The forward and the inverse kinematics of one arm with six revolute joints.
class ArmSolver {
 public:
  virtual ~ArmSolver() = default;

  // Returns X_BaseFlange, the pose of the flange in the base.
  virtual Pose Forward(const JointVector& q) const = 0;
  // Returns all joint vectors that put the flange at X_BaseFlange, each angle in [-pi, pi], without
  // regard to joint limits. At singular poses, joints that are free have the values of `reference`.
  virtual InverseSolutions Inverse(const Pose& X_BaseFlange,
                                   const JointVector& reference) const = 0;
  // Returns the solution with these indicators. If there are several, it is the one nearest to the
  // reference; if there is none, nothing is returned.
  virtual std::optional<JointVector> Inverse(const Pose& X_BaseFlange, const Indicators& indicators,
                                             const JointVector& reference) const = 0;

  virtual Indicators IndicatorsOf(const JointVector& q) const = 0;
  // Returns true if no two solutions of a regular pose have the same indicators.
  virtual bool TellsAllApart() const = 0;

  // Returns true if the last three axes meet in one point.
  virtual bool HasSphericalWrist() const = 0;
  // Returns the place, in the flange's frame, of the point that JacobianAt is about: the point in
  // which the last three axes meet, or else the flange's origin.
  virtual Vector3 p_FlangeCenter() const = 0;
  virtual ArmJacobian JacobianAt(const JointVector& q) const = 0;
};

}  // namespace assay::kinematics
