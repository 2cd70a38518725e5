#pragma once

#include <algorithm>
#include <limits>

#include "planner/finemotion/contacts/placed_part.h"

// Where two edges come nearest to each other. Contacts are found and linearized for every motion
// that a search tries, so these functions stand in a header.
namespace assay::finemotion {

// The points of two lines that are nearest to each other.
struct Crossing {
  double s = 0;  // metres along the first edge from its start
  double t = 0;  // metres along the second edge from its start
};

inline bool IsOnBoth(const Crossing& at, double length_a, double length_b) {
  return at.s >= 0 && at.s <= length_a && at.t >= 0 && at.t <= length_b;
}

inline double DistanceToEdge(const Vector3& p, const PlacedEdge& edge, double length) {
  const double s = std::clamp((p - edge.start).dot(edge.direction), 0.0, length);
  return (p - edge.start - s * edge.direction).norm();
}

// Returns the points of the two edges' lines that are nearest to each other. `sine2` is the squared
// sine of the angle between the lines, which must not be 0.
inline Crossing CrossingOf(const PlacedEdge& a, const PlacedEdge& b, double sine2) {
  const Vector3 between = a.start - b.start;
  const double c = a.direction.dot(b.direction);
  return {(c * b.direction - a.direction).dot(between) / sine2,
          (b.direction - c * a.direction).dot(between) / sine2};
}

// Returns the nearest points of two nearly parallel edges.
inline Crossing NearestOf(const PlacedEdge& a, double length_a, const PlacedEdge& b,
                          double length_b) {
  const Vector3 between = a.start - b.start;
  const double sine2 = a.direction.cross(b.direction).squaredNorm();
  if (sine2 > kSameDirection * kSameDirection) {
    const Crossing at = CrossingOf(a, b, sine2);
    if (IsOnBoth(at, length_a, length_b)) return at;
  }
  Crossing nearest;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Crossing& at) {
    const double distance = (between + at.s * a.direction - at.t * b.direction).norm();
    if (distance >= least) return;
    least = distance;
    nearest = at;
  };
  for (const double s : {0.0, length_a}) {
    const double t = (between + s * a.direction).dot(b.direction);
    consider({s, std::clamp(t, 0.0, length_b)});
  }
  for (const double t : {0.0, length_b}) {
    const double s = (t * b.direction - between).dot(a.direction);
    consider({std::clamp(s, 0.0, length_a), t});
  }
  return nearest;
}

// Returns whether two edges that are not parallel are farther apart than the reach.
inline bool AreBeyondReach(const PlacedEdge& a, double length_a, const PlacedEdge& b,
                           double length_b, const Crossing& at, double reach) {
  if (IsOnBoth(at, length_a, length_b)) return false;
  const Vector3 end_a = a.start + length_a * a.direction;
  const Vector3 end_b = b.start + length_b * b.direction;
  return DistanceToEdge(a.start, b, length_b) > reach &&
         DistanceToEdge(end_a, b, length_b) > reach &&
         DistanceToEdge(b.start, a, length_a) > reach && DistanceToEdge(end_b, a, length_a) > reach;
}

// Returns whether edges with this sine of their angle may be parallel after a turn (radians).
inline bool MayBeParallel(double sine, double turn) { return sine < kSameDirection + turn; }

}  // namespace assay::finemotion
