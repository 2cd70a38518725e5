#pragma once

#include <memory>
#include <optional>

#include "planner/kinematics/arm.h"
#include "planner/kinematics/inverse/serial_chain.h"

namespace assay::peers {

// Orocos KDL's Levenberg-Marquardt solver for the same arm. It finds one solution for each pose,
// from a start near the middle of the joints' ranges, to 1e-5 metres and 1e-3 radians (its
// defaults).
class KdlInverse {
 public:
  // The chain must have six joints.
  explicit KdlInverse(const kinematics::SerialChain& arm);
  ~KdlInverse();

  // Returns a solution, or none if the solver does not converge.
  std::optional<kinematics::JointVector> Solve(const geometry::Pose& X_BaseFlange);

 private:
  class Solver;
  std::unique_ptr<Solver> solver_;
};

}  // namespace assay::peers
