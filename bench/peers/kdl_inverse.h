#pragma once

#include <memory>
#include <optional>

#include "planner/kinematics/arm.h"

namespace assay::peers {

// Orocos KDL's Levenberg-Marquardt solver on the same arm: one solution a pose, from a start near
// the middle of the joints' ranges, to 1e-5 metres and 1e-3 radians, as its defaults have it.
class KdlInverse {
 public:
  explicit KdlInverse(const kinematics::RobotModel& model);
  ~KdlInverse();

  // Empty if the solver does not converge.
  std::optional<kinematics::JointVector> Solve(const geometry::Pose& X_BaseFlange);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace assay::peers
