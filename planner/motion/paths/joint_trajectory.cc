#include "planner/motion/paths/joint_trajectory.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/check.h"

namespace assay::motion {
namespace {

using Knot = JointTrajectory::Knot;

// Returns the cubic with the given values and derivatives at the ends (Hermite).
JointState Between(const Knot& a, const Knot& b, double time) {
  const double h = b.time - a.time;
  const double u = (time - a.time) / h;
  const double v = 1 - u;
  const JointVector slope = (b.state.q - a.state.q) / h;
  return {.q = v * v * (1 + 2 * u) * a.state.q + u * u * (1 + 2 * v) * b.state.q +
               h * u * v * (v * a.state.qd - u * b.state.qd),
          .qd = 6 * u * v * slope + v * (1 - 3 * u) * a.state.qd + u * (1 - 3 * v) * b.state.qd};
}

// Returns the acceleration of this cubic.
JointVector AccelerationBetween(const Knot& a, const Knot& b, double share) {
  const double h = b.time - a.time;
  const JointVector slope = (b.state.q - a.state.q) / h;
  return ((6 - 12 * share) * slope - (4 - 6 * share) * a.state.qd - (2 - 6 * share) * b.state.qd) /
         h;
}

int LooksBetween(const JointVector& from, const JointVector& to) {
  constexpr double kTurnPerLook = 0.05;  // radians
  return 1 + static_cast<int>(std::ceil((to - from).cwiseAbs().maxCoeff() / kTurnPerLook));
}

// A trapezoid of velocity over time, in shares of a motion's way.
struct Trapezoid {
  double cruise = 0;    // 1/s
  double ramp = 0;      // time of speeding up, and equally of slowing down; seconds
  double duration = 0;  // seconds; 0: nothing moves
};

Trapezoid FastestTrapezoid(const JointVector& way, const JointRates& rates) {
  double speed = std::numeric_limits<double>::infinity();
  double acceleration = speed;
  for (int j = 0; j < way.size(); ++j) {
    if (way[j] == 0) continue;
    speed = std::min(speed, rates.speed[j] / std::abs(way[j]));
    acceleration = std::min(acceleration, rates.acceleration[j] / std::abs(way[j]));
  }
  if (std::isinf(speed)) return {};
  // With the second value, the motion never cruises.
  speed = std::min(speed, std::sqrt(acceleration));
  const double ramp = speed / acceleration;
  return {.cruise = speed, .ramp = ramp, .duration = 1 / speed + ramp};
}

// Adds a synchronized move from the last knot's posture, unless the arm is there already.
void Append(const JointVector& to, const JointRates& rates, std::vector<Knot>& knots) {
  const Knot start = knots.back();
  const JointVector& from = start.state.q;
  const auto [speed, ramp, total] = FastestTrapezoid(to - from, rates);
  if (total == 0) return;
  const JointVector cruise = speed * (to - from);
  knots.push_back({start.time + ramp, {from + ramp / 2 * cruise, cruise}});
  if (total > 2 * ramp * (1 + 1e-12)) {
    knots.push_back({start.time + (total - ramp), {to - ramp / 2 * cruise, cruise}});
  }
  knots.push_back({start.time + total, {to, JointVector::Zero()}});
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

std::vector<JointMotion> JointTrajectory::Instants() const {
  std::vector<JointMotion> instants;
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const Knot& a = knots_[i];
    const Knot& b = knots_[i + 1];
    const int looks = LooksBetween(a.state.q, b.state.q);
    for (int look = 0; look <= looks; ++look) {
      const double share = static_cast<double>(look) / looks;
      const JointState state = At(a.time + share * (b.time - a.time));
      instants.push_back({state.q, state.qd, AccelerationBetween(a, b, share)});
    }
  }
  return instants;
}

JointTrajectory JointTrajectory::SlowedDown(double factor) const {
  std::vector<Knot> knots = knots_;
  for (Knot& knot : knots) {
    knot.time *= factor;
    knot.state.qd /= factor;
  }
  return JointTrajectory(std::move(knots));
}

JointRates RatesOf(const domain::Workcell& workcell) {
  JointRates rates{.acceleration = workcell.joint_acceleration()};
  for (int j = 0; j < rates.speed.size(); ++j) {
    rates.speed[j] = workcell.arm().limits()[static_cast<std::size_t>(j)].velocity;
  }
  return rates;
}

JointTrajectory SynchronizedMove(const JointVector& from, const JointVector& to,
                                 const JointRates& rates) {
  return AlongPath({from, to}, rates);
}

double MoveDuration(const JointVector& from, const JointVector& to, const JointRates& rates) {
  return FastestTrapezoid(to - from, rates).duration;
}

JointTrajectory AlongPath(const JointPath& path, const JointRates& rates) {
  ASSAY_CHECK(!path.empty());
  std::vector<Knot> knots = {{0, {path.front(), JointVector::Zero()}}};
  for (const JointVector& corner : path) Append(corner, rates, knots);
  return JointTrajectory(std::move(knots));
}

}  // namespace assay::motion
