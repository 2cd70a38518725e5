#include "planner/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/base/check.h"

namespace assay::geometry {
namespace {

double Cross(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

// Returns twice the area of the triangle a b c. It is positive if the triangle turns left.
double Turn(const Vector2& a, const Vector2& b, const Vector2& c) { return Cross(b - a, c - a); }

// Appends p to a chain that turns left at every corner. Removes the corners at which it would not
// turn left, except for those before `first`.
void Extend(Polygon& chain, size_t first, const Vector2& p) {
  while (chain.size() >= first + 2 && Turn(chain.end()[-2], chain.back(), p) <= 0) chain.pop_back();
  chain.push_back(p);
}

// Writes the part of a polygon to the left of the line from a to b.
void ClipLeft(const Polygon& polygon, const Vector2& a, const Vector2& b, Polygon& kept) {
  kept.clear();
  Vector2 p = polygon.back();
  double at_p = Turn(a, b, p);
  for (const Vector2& q : polygon) {
    const double at_q = Turn(a, b, q);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      kept.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    if (at_q >= 0) kept.push_back(q);
    p = q;
    at_p = at_q;
  }
}

double DistanceToSegment(const Vector2& a, const Vector2& b, const Vector2& p) {
  const Vector2 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(along.dot(p - a) / length2, 0.0, 1.0) : 0.0;
  return (a + t * along - p).norm();
}

// Returns how far b lies beyond a along a direction, or minus infinity if the direction is zero.
double SeparationAlong(const Polygon& a, const Polygon& b, const Vector2& direction) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double length = direction.norm();
  if (length == 0) return -kInfinity;
  double a_high = -kInfinity;
  double b_low = kInfinity;
  for (const Vector2& p : a) a_high = std::max(a_high, direction.dot(p));
  for (const Vector2& p : b) b_low = std::min(b_low, direction.dot(p));
  return (b_low - a_high) / length;
}

double SeparationAlongNormals(const Polygon& a, const Polygon& b, double enough) {
  double best = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < a.size() && best < enough; ++i) {
    const Vector2 edge = a[(i + 1) % a.size()] - a[i];
    best = std::max(best, SeparationAlong(a, b, {edge.y(), -edge.x()}));
  }
  return best;
}

}  // namespace

Polygon Hull2(std::span<const Vector2> points) {
  std::vector<Vector2> sorted(points.begin(), points.end());
  std::ranges::sort(sorted, [](const Vector2& a, const Vector2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  if (sorted.size() < 3) return sorted;
  Polygon hull;
  hull.reserve(sorted.size() + 1);
  for (const Vector2& p : sorted) Extend(hull, 0, p);
  const size_t upper = hull.size() - 1;
  for (auto p = sorted.rbegin() + 1; p != sorted.rend(); ++p) Extend(hull, upper, *p);
  hull.pop_back();
  return hull;
}

double Area(const Polygon& polygon) {
  double doubled = 0;
  for (size_t i = 2; i < polygon.size(); ++i) {
    doubled += Turn(polygon[0], polygon[i - 1], polygon[i]);
  }
  return doubled / 2;
}

Vector2 Centroid(const Polygon& polygon) {
  ASSAY_CHECK(!polygon.empty());
  Vector2 weighted = Vector2::Zero();
  double doubled = 0;
  for (size_t i = 2; i < polygon.size(); ++i) {
    const double turn = Turn(polygon[0], polygon[i - 1], polygon[i]);
    weighted += turn / 3 * (polygon[i - 1] - polygon[0] + polygon[i] - polygon[0]);
    doubled += turn;
  }
  if (doubled > 0) return polygon[0] + weighted / doubled;
  Vector2 sum = Vector2::Zero();
  for (const Vector2& p : polygon) sum += p;
  return sum / static_cast<double>(polygon.size());
}

double RadiusOfGyration(std::span<const Polygon> polygons) {
  Vector2 middle = Vector2::Zero();
  double area = 0;
  for (const Polygon& polygon : polygons) {
    if (polygon.empty()) continue;
    middle += Area(polygon) * Centroid(polygon);
    area += Area(polygon);
  }
  if (area <= 0) return 0;
  middle /= area;
  double moment = 0;  // the integral of the squared distance from the centroid
  for (const Polygon& polygon : polygons) {
    for (size_t i = 0; i < polygon.size(); ++i) {
      const Vector2 a = polygon[i] - middle;
      const Vector2 b = polygon[(i + 1) % polygon.size()] - middle;
      moment += (a.x() * b.y() - a.y() * b.x()) / 12 * (a.dot(a) + b.dot(b) + a.dot(b));
    }
  }
  return std::sqrt(moment / area);
}

Polygon Intersection(const Polygon& a, const Polygon& b) {
  if (a.size() < 3 || b.size() < 3) return {};
  Polygon kept = a;
  Polygon clipped;
  for (size_t i = 0; i < b.size() && !kept.empty(); ++i) {
    ClipLeft(kept, b[i], b[(i + 1) % b.size()], clipped);
    kept.swap(clipped);
  }
  kept = Hull2(kept);  // a corner on a clipping line occurs twice
  return Area(kept) > 0 ? kept : Polygon{};
}

double Depth(const Polygon& polygon, const Vector2& p) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (polygon.empty()) return -kInfinity;
  if (polygon.size() < 3) return -DistanceToSegment(polygon.front(), polygon.back(), p);
  double depth = kInfinity;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& q = polygon[(i + 1) % polygon.size()];
    if (q == polygon[i]) continue;
    depth = std::min(depth, Turn(polygon[i], q, p) / (q - polygon[i]).norm());
  }
  return depth;
}

// The polygon is clipped by a rectangle on the inner side of each edge, wide enough for all of it.
Polygon Inset(const Polygon& polygon, double depth) {
  double length = 0;
  for (const Vector2& p : polygon) length = std::max(length, (p - polygon.front()).norm());
  Polygon inset = polygon;
  for (std::size_t i = 0; i < polygon.size() && !inset.empty(); ++i) {
    const Vector2 along = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
    const Vector2 inward(-along.y(), along.x());
    const Vector2 from = polygon[i] + depth * inward;
    const Vector2 side = 2 * length * along;
    const Vector2 far = 2 * length * inward;
    inset = Intersection(inset, {from - side, from + side, from + side + far, from - side + far});
  }
  return inset;
}

// The separation is greatest along the normal of an edge or, if a corner faces a corner, along the
// line between both corners. Overlapping polygons need only the normals. No direction overstates
// the separation, so all may be tried.
double Gap(const Polygon& a, const Polygon& b, double enough) {
  ASSAY_CHECK(!a.empty() && !b.empty());
  double best = SeparationAlongNormals(a, b, enough);
  if (best < enough) best = std::max(best, SeparationAlongNormals(b, a, enough));
  if (best >= enough || (std::isfinite(best) && best < 0)) return best;
  for (const Vector2& p : a) {
    for (const Vector2& q : b) best = std::max(best, SeparationAlong(a, b, q - p));
  }
  return std::isfinite(best) ? best : 0.0;  // two equal points have no direction to try
}

}  // namespace assay::geometry
