#pragma once

#include <vector>

#include "planner/kinematics/arm.h"
#include "sim/scene/servo.h"

namespace assay::exec {

using kinematics::JointVector;
using scene::JointState;

// Joint values over time: cubic between knots, with continuous velocity.
class JointTrajectory {
 public:
  struct Knot {
    double time = 0;  // seconds, increasing from 0
    JointState state;
  };

  explicit JointTrajectory(std::vector<Knot> knots);  // at least one (checked)

  double duration() const { return knots_.back().time; }
  const std::vector<Knot>& knots() const { return knots_; }
  JointState At(double time) const;  // the ends' states before and after

 private:
  std::vector<Knot> knots_;
};

// What the joints may do, rad/s and rad/s^2.
struct JointRates {
  JointVector speed = JointVector::Zero();
  JointVector acceleration = JointVector::Zero();
};

// From rest at `from` to rest at `to`, all joints starting and stopping together, each with the
// same trapezoid of velocity: the fastest that breaks none of the rates.
JointTrajectory SynchronizedMove(const JointVector& from, const JointVector& to,
                                 const JointRates& rates);

}  // namespace assay::exec
