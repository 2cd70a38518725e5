#pragma once

#include <span>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/coordinates.h"
#include "sim/sense/view.h"

namespace assay::geometry {
struct ConvexHull;
}  // namespace assay::geometry

namespace assay::sense {

// Returns the outline of each convex solid (world frame) in the view, pixels. The union of the
// outlines is the silhouette of all solids.
std::vector<geometry::Polygon> Shadows(std::span<const geometry::ConvexHull> solids,
                                       const View& view);

// A point of a contour.
struct ContourPoint {
  Vector3 p_World;  // metres, a point on an edge of a solid
  Vector2 pixel;    // the point's place in the picture
  Vector2 normal;   // the contour's outward unit normal in the picture
};

// The distance in pixels within which a contour point must have no other contour.
inline constexpr double kContourReach = 2.5;
// Returns points of the contour of the solids' silhouette about every `spacing` pixels, including
// the inner contours around through holes. Points without a clean edge are left out: those near the
// ends of straight pieces, and those with another contour within kContourReach on the same normal.
std::vector<ContourPoint> Contour(std::span<const geometry::ConvexHull> solids, const View& view,
                                  double spacing);

}  // namespace assay::sense
