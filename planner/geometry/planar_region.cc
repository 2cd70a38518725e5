#include "planner/geometry/planar_region.h"

#include "planner/base/check.h"
#include "planner/geometry/polygon.h"

namespace assay::geometry {
namespace {

// Polygons whose overlap is less than this only touch, metres.
constexpr double kLeastOverlap = 1e-9;

// Returns the part of a convex polygon to the left of the line from a to b.
Polygon LeftOf(const Polygon& polygon, const Vector2& a, const Vector2& b) {
  const Vector2 left = Vector2(a.y() - b.y(), b.x() - a.x());
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& p = polygon[i];
    const Vector2& q = polygon[(i + 1) % polygon.size()];
    const double at_p = left.dot(p - a);
    const double at_q = left.dot(q - a);
    if (at_p >= 0) kept.push_back(p);
    if (at_p * at_q < 0) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return Hull2(kept);
}

Eigen::AlignedBox2d BoundsOf(const Polygon& polygon) {
  Eigen::AlignedBox2d bounds;
  for (const Vector2& p : polygon) bounds.extend(p);
  return bounds;
}

// Appends the pieces of the polygon that lie outside each edge of the cut in turn. What remains at
// the end is inside all edges.
void AppendOutside(Polygon polygon, const Polygon& cut, Patches& patches) {
  for (std::size_t i = 0; i < cut.size(); ++i) {
    const Vector2& a = cut[i];
    const Vector2& b = cut[(i + 1) % cut.size()];
    Polygon outside = LeftOf(polygon, b, a);
    if (Area(outside) > kSliverArea) patches.push_back(std::move(outside));
    polygon = LeftOf(polygon, a, b);
  }
}

}  // namespace

Patches Without(const Patches& region, const Polygon& cut) {
  if (Area(cut) < kSliverArea) return region;
  Patches rest;
  for (const Polygon& patch : region) {
    if (Gap(patch, cut) > -kLeastOverlap) {
      rest.push_back(patch);
    } else {
      AppendOutside(patch, cut, rest);
    }
  }
  return rest;
}

Patches Common(const Patches& a, const Patches& b) {
  Patches common;
  for (const Polygon& p : a) {
    const Eigen::AlignedBox2d bounds = BoundsOf(p);
    for (const Polygon& q : b) {
      if (!bounds.intersects(BoundsOf(q))) continue;
      Polygon both = Intersection(p, q);
      if (Area(both) > kSliverArea) common.push_back(std::move(both));
    }
  }
  return common;
}

double Area(const Patches& region) {
  double area = 0;
  for (const Polygon& patch : region) area += Area(patch);
  return area;
}

Vector2 Centroid(const Patches& region) {
  Vector2 weighted = Vector2::Zero();
  for (const Polygon& patch : region) weighted += Area(patch) * Centroid(patch);
  const double area = Area(region);
  ASSAY_CHECK(area > 0);
  return weighted / area;
}

Polygon Hull(const Patches& region) {
  std::vector<Vector2> corners;
  for (const Polygon& patch : region) corners.insert(corners.end(), patch.begin(), patch.end());
  return Hull2(corners);
}

bool Meets(const Patches& region, const Polygon& polygon) {
  return Area(Common(region, {polygon})) > kSliverArea;
}

// The missing area is compared, and not the missing width: a region that lacks a strip as thin as
// rounding still fills the polygon.
bool Fills(const Patches& region, const Polygon& polygon) {
  constexpr double kMissing = 1e-6;  // share of the area
  const double area = Area(polygon);
  return Area(Common(region, {polygon})) >= (1 - kMissing) * area;
}

}  // namespace assay::geometry
