#pragma once

#include <vector>

#include "planner/domain/workcell.h"
#include "planner/motion/joint_path.h"

namespace assay::motion {

using kinematics::JointVector;

// What the joints may do, rad/s and rad/s^2.
struct JointRates {
  JointVector speed = JointVector::Zero();
  JointVector acceleration = JointVector::Zero();
};

JointRates RatesOf(const domain::Workcell& workcell);

// A motion straight in joint space, from rest to rest: all joints start and stop together, each
// with the same trapezoid of velocity; the fastest that breaks none of the rates.
class SynchronizedMove {
 public:
  SynchronizedMove(const JointVector& from, const JointVector& to, const JointRates& rates);

  double duration() const { return duration_; }  // seconds
  double ramp() const { return ramp_; }          // of speeding up, and of slowing down; seconds
  JointVector At(double time) const;             // the ends before and after
  JointVector VelocityAt(double time) const;     // rad/s

 private:
  JointVector from_;
  JointVector way_;
  double ramp_ = 0;
  double duration_ = 0;
  double cruise_ = 0;  // of the whole way, per second
};

// A path in time: one synchronized move after the other, at rest in each corner, so that it stays
// exactly on the path that was found to be free.
class JointTrajectory {
 public:
  JointTrajectory(const JointPath& path,
                  const JointRates& rates);  // at least one posture (checked)

  double duration() const { return starts_.back(); }  // seconds
  const std::vector<SynchronizedMove>& moves() const { return moves_; }
  JointVector At(double time) const;
  JointVector VelocityAt(double time) const;

 private:
  std::size_t MoveAt(double time) const;

  std::vector<SynchronizedMove> moves_;
  std::vector<double> starts_;  // of the moves, and the end of the last
};

}  // namespace assay::motion
