#include "planner/algebra/bounds/feasible_ascent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/numeric/interval_arithmetic.h"

namespace assay::algebra {
namespace {

constexpr int kCrossings = 50;
constexpr int kAscents = 60;
constexpr int kStepHalvings = 50;
constexpr double kTouching = 1e-9;  // relative slack: an inequality with less blocks a step
constexpr double kInward = 1e-10;   // how steeply a step along an inequality leaves it

using Vector = std::vector<double>;

double DotProduct(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

Vector Along(const Vector& start, const Vector& direction, double length, const Box& box) {
  Vector end = start;
  for (std::size_t i = 0; i < end.size(); ++i) {
    end[i] = std::clamp(start[i] + length * direction[i], box[i].low, box[i].high);
  }
  return end;
}

// Removes from a direction the components that lead out of the box or across an inequality that the
// point touches.
class Deflection {
 public:
  Deflection(const Vector& point, Probe& probe) : point_(point), box_(probe.problem().box) {
    for (Derivatives<double>& slack : probe.slacks_at_point()) {
      const double value = slack.Value(point);
      const Vector& slope = slack.Gradient();
      const double steepness = std::sqrt(DotProduct(slope, slope));
      if (!(steepness > 0) || !(value < kTouching * steepness)) continue;
      walls_.push_back(slope);
      for (double& x : walls_.back()) x /= steepness;
    }
  }

  Vector Of(Vector direction) const {
    // Removing one component may bring back another, so a few rounds are needed.
    for (int round = 0; round < 20; ++round) {
      StayInBox(direction);
      for (const Vector& wall : walls_) Deflect(wall, direction);
    }
    StayInBox(direction);
    return direction;
  }

 private:
  void StayInBox(Vector& direction) const {
    for (std::size_t i = 0; i < direction.size(); ++i) {
      const bool leaves = (direction[i] > 0 && point_[i] >= box_[i].high) ||
                          (direction[i] < 0 && point_[i] <= box_[i].low);
      if (leaves) direction[i] = 0;
    }
  }

  static void Deflect(const Vector& wall, Vector& direction) {
    const double across = DotProduct(direction, wall);
    if (across >= 0) return;
    const double inward = kInward * std::sqrt(DotProduct(direction, direction));
    for (std::size_t i = 0; i < wall.size(); ++i) direction[i] += (inward - across) * wall[i];
  }

  const Vector& point_;
  const Box& box_;
  std::vector<Vector> walls_;  // unit vectors towards the feasible side
};

// Takes the longest step that stays feasible and increases the value, to within a factor of two.
// Returns false if there is none.
bool TakeLongestStep(Vector& point, double& value, const Vector& direction, Probe& probe) {
  const Box& box = probe.problem().box;
  double longest = 0;
  for (std::size_t i = 0; i < point.size(); ++i) {
    const double room = direction[i] > 0 ? box[i].high - point[i] : point[i] - box[i].low;
    if (direction[i] != 0) longest = std::max(longest, room / std::abs(direction[i]));
  }
  double length = std::min(longest, 1e6);
  for (int i = 0; i < kStepHalvings; ++i, length /= 2) {
    Vector next = Along(point, direction, length, box);
    const double next_value = probe.Value(next);
    if (!(next_value > value + 1e-15 * std::abs(value)) || !probe.SurelyFeasible(next)) continue;
    point = std::move(next);
    value = next_value;
    return true;
  }
  return false;
}

}  // namespace

std::vector<double> ApproachFeasible(std::vector<double> start, Probe& probe) {
  Vector point = std::move(start);
  for (int i = 0; i < kCrossings && !probe.SurelyFeasible(point); ++i) {
    for (Derivatives<double>& slack : probe.slacks_at_point()) {
      const double value = slack.Value(point);
      const Vector& slope = slack.Gradient();
      const double steepness = DotProduct(slope, slope);
      if (!(value <= 0) || !(steepness > 0)) continue;
      // The step is a little longer than needed, so that the constraint is satisfied in spite of
      // rounding.
      const double length = -value / steepness * 1.001 + kTouching / std::sqrt(steepness);
      point = Along(point, slope, length, probe.problem().box);
    }
  }
  return point;
}

std::vector<double> AscendFeasibly(std::vector<double> start, Probe& probe) {
  Vector point = std::move(start);
  double value = probe.Value(point);
  for (int i = 0; i < kAscents; ++i) {
    probe.Value(point);
    const Vector direction = Deflection(point, probe).Of(probe.Gradient());
    if (!TakeLongestStep(point, value, direction, probe)) break;
  }
  return point;
}

}  // namespace assay::algebra
