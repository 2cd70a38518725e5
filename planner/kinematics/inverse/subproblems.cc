#include "planner/kinematics/inverse/subproblems.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace assay::kinematics {
namespace {

// A vector this short has no direction.
constexpr double kNoDirection = 1e-11;

Vector3 Across(const Vector3& k, const Vector3& p) { return p - k * k.dot(p); }

// Returns the two common vectors of the cones about k1 and k2 on which p1 and p2 turn. All vectors
// are unit vectors. If the cones do not meet, both results are the vector of the second cone that
// is nearest to the first. The vector is measured from k2, because p2 may be so near to k2 that its
// direction would be lost in the rounding of cosines.
std::array<Vector3, 2> CommonVectors(const Vector3& k1, const Vector3& p1, const Vector3& k2,
                                     const Vector3& p2) {
  const double radius = Across(k2, p2).norm();
  const double slant = k1.dot(k2);
  const Vector3 tilted = Across(k2, k1);
  const double sine = tilted.norm();
  const Vector3 e = tilted / sine;
  const Vector3 f = k2.cross(e);
  const double along = (k1.dot(p1) - slant * k2.dot(p2)) / sine;
  const double a = std::clamp(along, -radius, radius);
  const double b = std::sqrt((radius - a) * (radius + a));
  const Vector3 base = k2 * k2.dot(p2) + a * e;
  return {base + b * f, base - b * f};
}

}  // namespace

BoundedList<SubproblemAngles<1>, 2> SolveOneAngle(double cosine, double sine, double value,
                                                  double reference) {
  BoundedList<SubproblemAngles<1>, 2> found;
  const double radius = std::hypot(cosine, sine);
  if (radius < kNoDirection) {
    found.push_back({{reference}, std::abs(value) < kExactError, true});
    return found;
  }
  const double middle = std::atan2(sine, cosine);
  const double radicand = (radius - value) * (radius + value);
  if (radicand <= 0) {
    const double nearest =
        value > 0 ? middle : std::remainder(middle + std::numbers::pi, 2 * std::numbers::pi);
    found.push_back({{nearest}, std::abs(value) - radius < kExactError, false});
    return found;
  }
  const double half = std::atan2(std::sqrt(radicand), value);
  found.push_back({{std::remainder(middle + half, 2 * std::numbers::pi)}});
  found.push_back({{std::remainder(middle - half, 2 * std::numbers::pi)}});
  return found;
}

SubproblemAngles<1> TurnToVector(const Vector3& k, const Vector3& p1, const Vector3& p2,
                                 double reference) {
  const Vector3 u = Across(k, p1);
  const Vector3 v = Across(k, p2);
  const double lengths[2] = {u.norm(), v.norm()};
  const bool exact = std::hypot(k.dot(p1 - p2), lengths[0] - lengths[1]) < kExactError;
  if (std::min(lengths[0], lengths[1]) < kNoDirection) return {{reference}, exact, true};
  return {{std::atan2(k.dot(u.cross(v)), u.dot(v))}, exact, false};
}

BoundedList<SubproblemAngles<2>, 2> TurnTogether(const Vector3& k1, const Vector3& p1,
                                                 const Vector3& k2, const Vector3& p2,
                                                 const std::array<double, 2>& reference) {
  BoundedList<SubproblemAngles<2>, 2> found;
  const double length1 = p1.norm();
  const double length2 = p2.norm();
  if (std::min(length1, length2) < kNoDirection) {
    found.push_back({reference, std::abs(length1 - length2) < kExactError, true});
    return found;
  }
  const Vector3 u1 = p1 / length1;
  const Vector3 u2 = p2 / length2;
  if (k1.cross(k2).norm() < kNoDirection) {
    const Vector3 turned = Eigen::AngleAxisd(reference[0], k1) * p1;
    const SubproblemAngles<1> second = TurnToVector(k2, p2, turned, reference[1]);
    found.push_back({{reference[0], second.q[0]}, second.exact, true});
    return found;
  }
  const std::array<Vector3, 2> common = Across(k1, u1).norm() < Across(k2, u2).norm()
                                            ? CommonVectors(k2, u2, k1, u1)
                                            : CommonVectors(k1, u1, k2, u2);
  for (const Vector3& vector : common) {
    const SubproblemAngles<1> first = TurnToVector(k1, u1, vector, reference[0]);
    const SubproblemAngles<1> second = TurnToVector(k2, u2, vector, reference[1]);
    const bool exact = first.exact && second.exact && std::abs(length1 - length2) < kExactError;
    found.push_back({{first.q[0], second.q[0]}, exact, first.free || second.free});
    if ((common[0] - common[1]).norm() < kNoDirection) break;
  }
  return found;
}

BoundedList<SubproblemAngles<1>, 2> TurnToHeight(const Vector3& k, const Vector3& p,
                                                 const Vector3& h, double height,
                                                 double reference) {
  return SolveOneAngle(h.dot(Across(k, p)), h.dot(k.cross(p)), height - h.dot(k) * k.dot(p),
                       reference);
}

BoundedList<SubproblemAngles<1>, 2> TurnToDistance(const Vector3& k, const Vector3& p1,
                                                   const Vector3& p2, double distance,
                                                   double reference) {
  const double height = (p1.squaredNorm() + p2.squaredNorm() - distance * distance) / 2;
  BoundedList<SubproblemAngles<1>, 2> found;
  for (SubproblemAngles<1> angle : TurnToHeight(k, p1, p2, height, reference)) {
    const Vector3 turned = Eigen::AngleAxisd(angle.q[0], k) * p1;
    angle.exact = std::abs((turned - p2).norm() - distance) < kExactError;
    found.push_back(angle);
  }
  return found;
}

// The last axis moves `from`, and the first axis moves `to`, on circles. The middle axis can bring
// a point of one circle to a point of the other if both are at the same height along it and at the
// same distance from a point of it. Both equations are linear in the cosines and sines of the outer
// angles.
BoundedList<SubproblemAngles<3>, 4> TurnToPoint(const std::array<JointAxis, 3>& axes,
                                                const Vector3& from, const Vector3& to,
                                                const std::array<double, 3>& reference) {
  const TurnCircle first = CircleOf(axes[0], to);  // turned backward
  const TurnCircle last = CircleOf(axes[2], from);
  const Vector3& h = axes[1].direction;
  const Vector3& p = axes[1].point;
  const Vector3 m1 = first.centre - p;
  const Vector3 m3 = last.centre - p;
  const double squares =
      m1.squaredNorm() + first.along.squaredNorm() - m3.squaredNorm() - last.along.squaredNorm();
  const std::array<TwoAngleEquation, 2> equations = {
      {{-h.dot(first.along), h.dot(first.across), h.dot(last.along), h.dot(last.across),
        h.dot(m1 - m3)},
       {-m1.dot(first.along), m1.dot(first.across), m3.dot(last.along), m3.dot(last.across),
        squares / 2}}};
  BoundedList<SubproblemAngles<3>, 4> found;
  for (const SubproblemAngles<2>& outer : SolveTwoAngles(equations, {reference[0], reference[2]})) {
    const Vector3 before = last.At(outer.q[1]) - p;
    const Vector3 after = first.At(-outer.q[0]) - p;
    const SubproblemAngles<1> middle = TurnToVector(h, before, after, reference[1]);
    found.push_back({{outer.q[0], middle.q[0], outer.q[1]},
                     outer.exact && middle.exact,
                     outer.free || middle.free});
  }
  return found;
}

}  // namespace assay::kinematics
