#include "planner/geometry/solids/polygon_pieces.h"

#include <algorithm>

#include "planner/geometry/outline.h"
#include "planner/geometry/solids/triangulation.h"

namespace assay::geometry {
namespace {

constexpr double kSamePlace = 1e-9;  // metres
constexpr double kSliverTwice =
    1e-16;  // twice the area of a triangle that is a line, square metres

std::vector<Polygon> MergedInPlane(const std::vector<Polygon>& polygons) {
  std::vector<Outline> region;
  for (const Polygon& polygon : polygons) {
    Outline& outline = region.emplace_back();
    for (const Vector2& p : polygon) outline.emplace_back(p.x(), p.y(), 0);
  }
  std::vector<Polygon> merged;
  for (const Outline& outline : Merged(std::move(region), Vector3::UnitZ(), kSamePlace)) {
    Polygon& polygon = merged.emplace_back();
    for (const Vector3& p : outline) polygon.push_back(p.head<2>());
  }
  return merged;
}

// Adds the corners of a polygon, in the direction of turn that the sign asks for.
void AddLoop(const Ring& ring, double sign, std::vector<Vector2>& points,
             std::vector<Loop>& loops) {
  Loop& loop = loops.emplace_back();
  for (const Vector2& p : ring) {
    loop.push_back(static_cast<int>(points.size()));
    points.push_back(p);
  }
  if (SignedArea(ring) * sign < 0) std::ranges::reverse(loop);
}

}  // namespace

std::vector<Polygon> ConvexPieces(const Ring& outline, std::span<const Ring> holes) {
  std::vector<Vector2> points;
  std::vector<Loop> loops;
  AddLoop(outline, 1, points, loops);
  for (const Ring& hole : holes) AddLoop(hole, -1, points, loops);
  std::vector<Polygon> triangles;
  for (const auto& corners : Triangulated(points, loops)) {
    Polygon triangle;
    for (const int i : corners) triangle.push_back(points[static_cast<std::size_t>(i)]);
    if (2 * SignedArea(triangle) > kSliverTwice) triangles.push_back(std::move(triangle));
  }
  return MergedInPlane(triangles);
}

}  // namespace assay::geometry
