#pragma once

#include <vector>

#include "planner/domain/workcell/workcell.h"
#include "planner/motion/path/joint_path.h"

namespace assay::motion {

using kinematics::JointState;
using kinematics::JointVector;

// Joint values over time: cubic between knots, with continuous velocity.
class JointTrajectory {
 public:
  struct Knot {
    double time = 0;  // seconds, increasing from 0
    JointState state;
  };

  explicit JointTrajectory(std::vector<Knot> knots);  // at least one (checked)

  double duration() const { return knots_.back().time; }  // seconds
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

JointRates RatesOf(const domain::Workcell& workcell);

// From rest at `from` to rest at `to`, straight in joint space: all joints start and stop together,
// each with the same trapezoid of velocity; the fastest that breaks none of the rates.
JointTrajectory SynchronizedMove(const JointVector& from, const JointVector& to,
                                 const JointRates& rates);

// How long that takes, seconds.
double MoveDuration(const JointVector& from, const JointVector& to, const JointRates& rates);

// A path in time: one synchronized move after the other, at rest in each corner, so that it stays
// exactly on the path that was found to be free. At least one posture (checked).
JointTrajectory AlongPath(const JointPath& path, const JointRates& rates);

}  // namespace assay::motion
