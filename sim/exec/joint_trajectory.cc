#include "sim/exec/joint_trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/check.h"

namespace assay::exec {
namespace {

using Knot = JointTrajectory::Knot;

// The cubic with the given values and derivatives at the ends (Hermite).
JointState Between(const Knot& a, const Knot& b, double time) {
  const double h = b.time - a.time;
  const double u = (time - a.time) / h;
  const double v = 1 - u;
  const JointVector slope = (b.state.q - a.state.q) / h;
  return {.q = v * v * (1 + 2 * u) * a.state.q + u * u * (1 + 2 * v) * b.state.q +
               h * u * v * (v * a.state.qd - u * b.state.qd),
          .qd = 6 * u * v * slope + v * (1 - 3 * u) * a.state.qd + u * (1 - 3 * v) * b.state.qd};
}

}  // namespace

JointTrajectory::JointTrajectory(std::vector<Knot> knots) : knots_(std::move(knots)) {
  ASSAY_CHECK(!knots_.empty() && knots_.front().time == 0);
}

JointState JointTrajectory::At(double time) const {
  const auto after = std::ranges::upper_bound(knots_, time, {}, &Knot::time);
  if (after == knots_.begin()) return knots_.front().state;
  if (after == knots_.end()) return knots_.back().state;
  return Between(*(after - 1), *after, time);
}

JointTrajectory SynchronizedMove(const JointVector& from, const JointVector& to,
                                 const JointRates& rates) {
  const JointVector way = to - from;
  double speed = std::numeric_limits<double>::infinity();  // of the whole way per second
  double acceleration = speed;
  for (int j = 0; j < way.size(); ++j) {
    if (way[j] == 0) continue;
    speed = std::min(speed, rates.speed[j] / std::abs(way[j]));
    acceleration = std::min(acceleration, rates.acceleration[j] / std::abs(way[j]));
  }
  if (std::isinf(speed)) return JointTrajectory({{0, {from, JointVector::Zero()}}});
  speed = std::min(speed, std::sqrt(acceleration));
  const double ramp = speed / acceleration;
  const double total = 1 / speed + ramp;
  const JointVector cruise = speed * way;
  std::vector<Knot> knots = {{0, {from, JointVector::Zero()}},
                             {ramp, {from + ramp / 2 * cruise, cruise}}};
  if (total > 2 * ramp * (1 + 1e-12)) {
    knots.push_back({total - ramp, {to - ramp / 2 * cruise, cruise}});
  }
  knots.push_back({total, {to, JointVector::Zero()}});
  return JointTrajectory(std::move(knots));
}

}  // namespace assay::exec
