#include "sim/execution/control/straight_line.h"

#include <algorithm>
#include <cmath>

namespace assay::execution {
namespace {

constexpr double kToolAcceleration = 1.5;  // m/s^2

// The first and second derivatives of a joint path by its length, computed by differences.
struct Derivatives {
  JointVector first;
  JointVector second;
};

Derivatives DerivativesAt(const LinePath& path, std::size_t i) {
  const std::size_t last = path.q.size() - 1;
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t after = std::min(i + 1, last);
  const std::size_t middle = std::clamp<std::size_t>(i, 1, std::max<std::size_t>(last, 2) - 1);
  Derivatives d;
  d.first = (path.q[after] - path.q[before]) / (static_cast<double>(after - before) * path.step);
  d.second.setZero();
  if (last >= 2) {
    d.second =
        (path.q[middle + 1] - 2 * path.q[middle] + path.q[middle - 1]) / (path.step * path.step);
  }
  return d;
}

struct PointLimits {
  double speed = 0;         // m/s
  double acceleration = 0;  // m/s^2
};

PointLimits LimitsAt(const Derivatives& d, double speed, const JointRates& rates) {
  constexpr double kTiny = 1e-12;
  PointLimits limits{speed, kToolAcceleration};
  for (int j = 0; j < d.first.size(); ++j) {
    const double first = std::abs(d.first[j]) + kTiny;
    const double second = std::abs(d.second[j]) + kTiny;
    const double acceleration = rates.acceleration[j] / 2;
    limits.speed =
        std::min({limits.speed, rates.speed[j] / first, std::sqrt(acceleration / second)});
    limits.acceleration = std::min(limits.acceleration, acceleration / first);
  }
  return limits;
}

// Lowers speed[to] to what can be reached from speed[from] one step away.
void Reach(std::vector<double>& speed, const std::vector<PointLimits>& limits, double step,
           std::size_t from, std::size_t to) {
  const double acceleration = std::min(limits[from].acceleration, limits[to].acceleration);
  speed[to] = std::min(speed[to], std::sqrt(speed[from] * speed[from] + 2 * acceleration * step));
}

std::vector<double> CompatibleSpeeds(const std::vector<PointLimits>& limits, double step) {
  std::vector<double> speed;
  for (const PointLimits& point : limits) speed.push_back(point.speed);
  speed.front() = 0;
  speed.back() = 0;
  for (std::size_t i = 1; i < speed.size(); ++i) Reach(speed, limits, step, i - 1, i);
  for (std::size_t i = speed.size() - 1; i > 0; --i) Reach(speed, limits, step, i, i - 1);
  return speed;
}

}  // namespace

JointTrajectory WithTimes(const LinePath& path, const Pace& pace, const JointRates& rates) {
  const std::size_t count = path.q.size();
  const double length = path.step * static_cast<double>(count - 1);
  if (length < 1e-9) return JointTrajectory({{0, {path.q.back(), JointVector::Zero()}}});
  std::vector<Derivatives> derivatives;
  std::vector<PointLimits> limits;
  for (std::size_t i = 0; i < count; ++i) {
    // The knot before the final length is slow too, so that all of the final length is slow.
    const bool final = length - path.step * static_cast<double>(i + 1) <= pace.final_length;
    derivatives.push_back(DerivativesAt(path, i));
    limits.push_back(LimitsAt(derivatives[i], final ? pace.final_speed : pace.speed, rates));
  }
  const std::vector<double> speed = CompatibleSpeeds(limits, path.step);
  std::vector<JointTrajectory::Knot> knots;
  double time = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) time += 2 * path.step / (speed[i - 1] + speed[i]);
    knots.push_back({time, {path.q[i], speed[i] * derivatives[i].first}});
  }
  return JointTrajectory(std::move(knots));
}

}  // namespace assay::execution
