#include "planner/finemotion/contacts/rim_crossing.h"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

namespace assay::finemotion {

namespace {

using geometry::Vector3;

constexpr int kArcs = 24;                // arcs of the first rim that are searched for crossings
constexpr int kHalvings = 6;             // of such an arc, before Newton's method
constexpr int kRounds = 12;              // of Newton's method
constexpr double kFarthestCrossing = 1;  // radians from where the rims cross in the projection
constexpr double kSolved = 1e-13;        // radians
constexpr double kLeastSine = 0.005;     // between rims that cross

// A rim with its points by angle.
struct Circle {
  Vector3 center;
  Vector3 x;
  Vector3 y;

  explicit Circle(const Rim& rim)
      : center(rim.center), x(rim.radius * rim.axis.unitOrthogonal()), y(rim.axis.cross(x)) {}

  Vector3 Arm(double angle) const { return std::cos(angle) * x + std::sin(angle) * y; }
  Vector3 Tangent(double angle) const { return std::cos(angle) * y - std::sin(angle) * x; }
};

class RimPair {
 public:
  RimPair(const Rim& first, const Rim& second) : first_(first), second_(second), rim_(second) {}

  // Returns how far the point of the first rim is outside the second one, as a difference of
  // squares.
  double Outside(double angle) const {
    const Vector3 to = first_.center + first_.Arm(angle) - second_.center;
    return to.squaredNorm() - std::pow(to.dot(rim_.axis), 2) - rim_.radius * rim_.radius;
  }

  // Returns the crossing near a point of the first rim that is on the second one in the projection.
  std::optional<RimCrossing> Near(double angle) const {
    const Vector3 to = first_.center + first_.Arm(angle) - second_.center;
    Eigen::Vector2d at(angle, std::atan2(to.dot(second_.y), to.dot(second_.x)));
    const Eigen::Vector2d start = at;
    double step = 1;
    for (int round = 0; round < kRounds && step > kSolved; ++round) {
      const Vector3 p = first_.Arm(at[0]);
      const Vector3 q = second_.Arm(at[1]);
      const Vector3 between = first_.center + p - second_.center - q;
      const Vector3 t = first_.Tangent(at[0]);
      const Vector3 v = second_.Tangent(at[1]);
      Eigen::Matrix2d slopes;
      slopes << t.squaredNorm() - p.dot(between), -t.dot(v), v.dot(t),
          -v.squaredNorm() - q.dot(between);
      const Eigen::Vector2d change =
          slopes.inverse() * Eigen::Vector2d(-t.dot(between), -v.dot(between));
      if (!change.allFinite()) return std::nullopt;
      step = change.norm();
      at += change;
    }
    if (step > 1e-9 || (at - start).norm() > kFarthestCrossing) return std::nullopt;
    return At(at);
  }

 private:
  std::optional<RimCrossing> At(const Eigen::Vector2d& at) const {
    const Vector3 n = first_.Tangent(at[0]).normalized().cross(second_.Tangent(at[1]).normalized());
    const double sine = n.norm();
    if (sine < kLeastSine) return std::nullopt;
    return RimCrossing{.on_first = first_.center + first_.Arm(at[0]),
                       .on_second = second_.center + second_.Arm(at[1]),
                       .normal = n / std::copysign(sine, n.dot(rim_.axis)),
                       .sine = sine};
  }

  Circle first_;
  Circle second_;
  Rim rim_;
};

}  // namespace

std::optional<RimCrossing> CrossingOf(const Rim& first, const Rim& second, int sense) {
  const RimPair pair(first, second);
  const double arc = 2 * std::numbers::pi / kArcs;
  std::optional<RimCrossing> nearest;
  double least = 0;
  double before = sense * pair.Outside(0);
  for (int i = 0; i < kArcs; ++i) {
    double low = i * arc;
    double high = low + arc;
    const double after = sense * pair.Outside(high);
    if (before < 0 && after >= 0) {
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = (low + high) / 2;
        (sense * pair.Outside(middle) < 0 ? low : high) = middle;
      }
      const auto crossing = pair.Near((low + high) / 2);
      const double distance = crossing ? (crossing->on_first - crossing->on_second).norm() : 0;
      if (crossing && (!nearest || distance < least)) {
        nearest = crossing;
        least = distance;
      }
    }
    before = after;
  }
  return nearest;
}

}  // namespace assay::finemotion
