#include "planner/motion/joint_trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/check.h"

namespace assay::motion {

JointRates RatesOf(const domain::Workcell& workcell) {
  JointRates rates{.acceleration = workcell.joint_acceleration()};
  for (int j = 0; j < rates.speed.size(); ++j) {
    rates.speed[j] = workcell.arm().limits()[static_cast<std::size_t>(j)].velocity;
  }
  return rates;
}

SynchronizedMove::SynchronizedMove(const JointVector& from, const JointVector& to,
                                   const JointRates& rates)
    : from_(from), way_(to - from) {
  double speed = std::numeric_limits<double>::infinity();  // of the whole way, per second
  double acceleration = speed;
  for (int j = 0; j < way_.size(); ++j) {
    if (way_[j] == 0) continue;
    speed = std::min(speed, rates.speed[j] / std::abs(way_[j]));
    acceleration = std::min(acceleration, rates.acceleration[j] / std::abs(way_[j]));
  }
  if (std::isinf(speed)) return;
  cruise_ = std::min(speed, std::sqrt(acceleration));  // the latter: it never cruises
  ramp_ = cruise_ / acceleration;
  duration_ = 1 / cruise_ + ramp_;
}

JointVector SynchronizedMove::At(double time) const {
  if (time <= 0 || ramp_ == 0) return from_;
  if (time >= duration_) return from_ + way_;
  const double left = duration_ - time;
  if (time < ramp_) return from_ + time * time / (2 * ramp_) * cruise_ * way_;
  if (left < ramp_) return from_ + (1 - left * left / (2 * ramp_) * cruise_) * way_;
  return from_ + (time - ramp_ / 2) * cruise_ * way_;
}

JointVector SynchronizedMove::VelocityAt(double time) const {
  if (ramp_ == 0) return JointVector::Zero();
  const double share = std::min({1.0, time / ramp_, (duration_ - time) / ramp_});
  return std::max(0.0, share) * cruise_ * way_;
}

JointTrajectory::JointTrajectory(const JointPath& path, const JointRates& rates) {
  ASSAY_CHECK(!path.empty());
  double end = 0;
  starts_.push_back(end);
  for (std::size_t i = 0; i + 1 < path.size() || moves_.empty(); ++i) {
    moves_.emplace_back(path[i], path[std::min(i + 1, path.size() - 1)], rates);
    end += moves_.back().duration();
    starts_.push_back(end);
  }
}

std::size_t JointTrajectory::MoveAt(double time) const {
  const auto after = std::ranges::upper_bound(starts_.begin() + 1, starts_.end() - 1, time);
  return static_cast<std::size_t>(after - starts_.begin()) - 1;
}

JointVector JointTrajectory::At(double time) const {
  const std::size_t i = MoveAt(time);
  return moves_[i].At(time - starts_[i]);
}

JointVector JointTrajectory::VelocityAt(double time) const {
  const std::size_t i = MoveAt(time);
  return moves_[i].VelocityAt(time - starts_[i]);
}

}  // namespace assay::motion
