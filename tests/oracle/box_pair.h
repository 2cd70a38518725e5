#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "planner/geometry/box.h"

// The volume of a box, the points within it, and the separation and distance of two boxes, slowly
// and by definition.
namespace assay::oracle {

using geometry::Box;
using geometry::Vector3;

inline double VolumeOf(const Box& box) { return 8 * box.half_extents.prod(); }

// Returns whether p is inside the box, or at most `tolerance` outside along one of its axes. A
// negative tolerance requires p to be at least that deep inside.
inline bool IsWithin(const Box& box, const Vector3& p, double tolerance) {
  const Vector3 in_box = box.X_FrameBox.inverse() * p;
  return ((in_box.cwiseAbs() - box.half_extents).array() <= tolerance).all();
}

// Returns the greatest separation over the 15 axes of Gottschalk, Lin and Manocha (1996), from the
// corners. For boxes that overlap, it is minus the least overlap. Cross products of nearly parallel
// edges are left out because they add nothing.
inline double Separation(const Box& a, const Box& b) {
  std::vector<Vector3> axes;
  for (int i = 0; i < 3; ++i) {
    axes.push_back(a.X_FrameBox.linear().col(i));
    axes.push_back(b.X_FrameBox.linear().col(i));
    for (int j = 0; j < 3; ++j) {
      const Vector3 cross = a.X_FrameBox.linear().col(i).cross(b.X_FrameBox.linear().col(j));
      if (cross.norm() > 1e-6) axes.push_back(cross.normalized());
    }
  }
  double best = -std::numeric_limits<double>::infinity();
  for (const Vector3& axis : axes) {
    std::array<double, 8> of_a, of_b;
    std::ranges::transform(a.Corners(), of_a.begin(),
                           [&](const Vector3& p) { return axis.dot(p); });
    std::ranges::transform(b.Corners(), of_b.begin(),
                           [&](const Vector3& p) { return axis.dot(p); });
    const auto [a_low, a_high] = std::ranges::minmax(of_a);
    const auto [b_low, b_high] = std::ranges::minmax(of_b);
    best = std::max({best, b_low - a_high, a_low - b_high});
  }
  return best;
}

inline double PointBoxDistance(const Vector3& p, const Box& box) {
  const Vector3 q = box.X_FrameBox.inverse() * p;
  return (q - q.cwiseMax(-box.half_extents).cwiseMin(box.half_extents)).norm();
}

inline double PointSegmentDistance(const Vector3& p, const Vector3& a, const Vector3& b) {
  const double t = (b - a).dot(p - a) / (b - a).squaredNorm();
  return (a + std::clamp(t, 0.0, 1.0) * (b - a) - p).norm();
}

// Returns the distance of two segments. Either an end is nearest or, if the segments are not
// parallel, two inner points are.
inline double SegmentDistance(const Vector3& a, const Vector3& b, const Vector3& c,
                              const Vector3& d) {
  double least = std::min({PointSegmentDistance(a, c, d), PointSegmentDistance(b, c, d),
                           PointSegmentDistance(c, a, b), PointSegmentDistance(d, a, b)});
  const Vector3 u = b - a, v = d - c, w = c - a;
  const Vector3 n = u.cross(v);
  if (n.norm() > 1e-9 * u.norm() * v.norm()) {
    const double s = w.cross(v).dot(n) / n.squaredNorm();
    const double t = w.cross(u).dot(n) / n.squaredNorm();
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
      least = std::min(least, (a + s * u - c - t * v).norm());
  }
  return least;
}

// Returns the distance of boxes that do not overlap. It is the distance of a corner from a box, or
// the distance of two edges.
inline double DisjointDistance(const Box& a, const Box& b) {
  const std::array<Vector3, 8> of_a = a.Corners(), of_b = b.Corners();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i) {
    least = std::min({least, PointBoxDistance(of_a[i], b), PointBoxDistance(of_b[i], a)});
  }
  // Corners whose numbers differ in one bit are the ends of an edge.
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < 8; ++j) {
      for (int bit : {1, 2, 4}) {
        for (int other : {1, 2, 4}) {
          if ((i & bit) != 0 || (j & other) != 0) continue;
          least =
              std::min(least, SegmentDistance(of_a[i], of_a[i | bit], of_b[j], of_b[j | other]));
        }
      }
    }
  }
  return least;
}

}  // namespace assay::oracle
