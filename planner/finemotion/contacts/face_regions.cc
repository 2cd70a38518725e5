#include "planner/finemotion/contacts/face_regions.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/polygon.h"

namespace assay::finemotion {

namespace {

using geometry::Polygon;
using geometry::Vector2;

constexpr double kSameExtent = 1e-6;  // relative difference of two areas below which they are equal

// Coordinates in a face's plane.
class FaceFrame {
 public:
  explicit FaceFrame(const OuterFace& face)
      : x_(face.normal.unitOrthogonal()),
        y_(face.normal.cross(x_)),
        foot_(face.height * face.normal) {}

  Vector2 Flat(const Vector3& p) const { return {x_.dot(p), y_.dot(p)}; }
  Vector3 Raised(const Vector2& q) const { return foot_ + Turned(q); }
  Vector3 Turned(const Vector2& q) const { return q.x() * x_ + q.y() * y_; }

 private:
  Vector3 x_;
  Vector3 y_;
  Vector3 foot_;
};

template <class Vector>
double DistanceToSegment(const Vector& p, const Vector& a, const Vector& b) {
  const Vector along = b - a;
  const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - a - t * along).norm();
}

// Returns the hull without corners that stick out by no more than rounding.
Polygon CleanHull(const std::vector<Vector2>& points) {
  Polygon hull = geometry::Hull2(points);
  for (std::size_t i = 0; hull.size() >= 3 && i < hull.size();) {
    const Vector2& before = hull[(i + hull.size() - 1) % hull.size()];
    if (DistanceToSegment(hull[i], before, hull[(i + 1) % hull.size()]) > kSamePoint) {
      ++i;
    } else {
      hull.erase(hull.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  return hull;
}

bool MergeOnePair(std::vector<Polygon>& polygons) {
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (std::size_t j = i + 1; j < polygons.size(); ++j) {
      std::vector<Vector2> corners = polygons[i];
      corners.insert(corners.end(), polygons[j].begin(), polygons[j].end());
      Polygon hull = CleanHull(corners);
      const double area = geometry::Area(hull);
      const double parts = geometry::Area(polygons[i]) + geometry::Area(polygons[j]);
      if (area - parts > kSameExtent * area) continue;
      polygons[i] = std::move(hull);
      polygons.erase(polygons.begin() + static_cast<std::ptrdiff_t>(j));
      return true;
    }
  }
  return false;
}

FaceRegion Raised(const Polygon& polygon, const FaceFrame& frame) {
  FaceRegion region;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& start = polygon[i];
    const Vector2& end = polygon[(i + 1) % polygon.size()];
    const Vector2 along = (end - start).normalized();
    RegionSide side{.outward = frame.Turned({along.y(), -along.x()}),
                    .height = 0,
                    .start = frame.Raised(start),
                    .end = frame.Raised(end)};
    side.height = side.outward.dot(side.middle());
    region.push_back(side);
  }
  return region;
}

}  // namespace

std::vector<FaceRegion> ConvexRegions(const OuterFace& face) {
  const FaceFrame frame(face);
  std::vector<Polygon> polygons;
  for (const std::vector<Vector3>& outline : face.region) {
    std::vector<Vector2> flat;
    for (const Vector3& corner : outline) flat.push_back(frame.Flat(corner));
    Polygon polygon = CleanHull(flat);
    if (polygon.size() >= 3) polygons.push_back(std::move(polygon));
  }
  while (MergeOnePair(polygons)) {
  }
  std::vector<FaceRegion> regions;
  for (const Polygon& polygon : polygons) regions.push_back(Raised(polygon, frame));
  return regions;
}

double DistanceTo(const FaceRegion& region, const Vector3& p) {
  const auto is_inside = [&](const RegionSide& side) { return side.Excess(p) <= 0; };
  if (std::ranges::all_of(region, is_inside)) return 0;
  double distance = std::numeric_limits<double>::infinity();
  for (const RegionSide& side : region) {
    distance = std::min(distance, DistanceToSegment(p, side.start, side.end));
  }
  return distance;
}

}  // namespace assay::finemotion
