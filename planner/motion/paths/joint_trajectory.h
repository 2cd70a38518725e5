#pragma once

#include <vector>

#include "planner/domain/workcell/workcell.h"
#include "planner/kinematics/dynamics/arm_dynamics.h"
#include "planner/motion/paths/joint_path.h"

namespace assay::motion {

using kinematics::JointMotion;
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
  JointState At(double time) const;  // before and after the motion: the states at its ends

  // Returns the motion at its knots and between them, such that no joint turns by more than 0.05
  // rad in between. Accelerations jump at knots, so both accelerations of a knot are given.
  std::vector<JointMotion> Instants() const;
  // Returns the same motion, evenly slowed down by this factor (1 or greater).
  JointTrajectory SlowedDown(double factor) const;

 private:
  std::vector<Knot> knots_;
};

// The greatest speeds and accelerations of the joints, in rad/s and rad/s^2.
struct JointRates {
  JointVector speed = JointVector::Zero();
  JointVector acceleration = JointVector::Zero();
};

JointRates RatesOf(const domain::Workcell& workcell);

// Returns the fastest motion from rest at `from` to rest at `to`, straight in joint space, that
// breaks none of the rates. All joints start and stop together, each with the same trapezoid of
// velocity.
JointTrajectory SynchronizedMove(const JointVector& from, const JointVector& to,
                                 const JointRates& rates);

// Returns the duration of SynchronizedMove, in seconds.
double MoveDuration(const JointVector& from, const JointVector& to, const JointRates& rates);

// Returns one synchronized move after the other along a path. They rest in each corner, and so stay
// exactly on the path that was found to be free. There must be at least one posture (checked).
JointTrajectory AlongPath(const JointPath& path, const JointRates& rates);

}  // namespace assay::motion
