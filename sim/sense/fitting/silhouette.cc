#include "sim/sense/fitting/silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"

namespace assay::sense {
namespace {

using geometry::ConvexHull;
using geometry::Polygon;

struct Corner {
  Vector3 p_World;
  Vector2 pixel;
};

// The vertices of a convex solid and its outline in the picture.
struct Shadow {
  std::vector<Corner> corners;
  Polygon outline;

  Shadow(const ConvexHull& solid, const View& view) {
    std::vector<Vector2> pixels;
    for (const Vector3& vertex : solid.vertices) {
      pixels.push_back(view.Project(vertex));
      corners.push_back({vertex, pixels.back()});
    }
    outline = geometry::Hull2(pixels);
  }

  const Vector3& CornerAt(const Vector2& pixel) const {
    return std::ranges::find_if(corners, [&](const Corner& c) { return c.pixel == pixel; })
        ->p_World;
  }
};

bool Covered(const std::vector<Shadow>& shadows, const Vector2& pixel) {
  return std::ranges::any_of(
      shadows, [&](const Shadow& shadow) { return geometry::Depth(shadow.outline, pixel) > 0; });
}

// Returns whether the silhouette ends at this pixel and no other contour is near on the same
// normal.
bool IsCleanContour(const std::vector<Shadow>& shadows, const Vector2& pixel,
                    const Vector2& normal) {
  constexpr double kJustOutside = 0.01;
  return Covered(shadows, pixel - kContourReach * normal) &&
         !Covered(shadows, pixel + kJustOutside * normal) &&
         !Covered(shadows, pixel + kContourReach * normal);
}

// Adds contour points on the edge between two neighbouring corners of a solid's outline.
void AddPoints(const std::vector<Shadow>& shadows, const std::array<Vector3, 2>& edge,
               const View& view, double spacing, std::vector<ContourPoint>& contour) {
  const Vector2 start = view.Project(edge[0]);
  const Vector2 along = view.Project(edge[1]) - start;
  const Vector2 normal = Vector2(along.y(), -along.x()).normalized();
  const int count = static_cast<int>((along.norm() - 2 * kContourReach) / spacing);
  for (int i = 0; i < count; ++i) {
    const double fraction = (i + 0.5) / count;
    const Vector3 p_World = edge[0] + fraction * (edge[1] - edge[0]);
    const Vector2 pixel = view.Project(p_World);
    const double from_end = std::min((pixel - start).norm(), (start + along - pixel).norm());
    if (from_end > kContourReach && IsCleanContour(shadows, pixel, normal)) {
      contour.push_back({p_World, pixel, normal});
    }
  }
}

}  // namespace

std::vector<Polygon> Shadows(std::span<const ConvexHull> solids, const View& view) {
  std::vector<Polygon> outlines;
  for (const ConvexHull& solid : solids) outlines.push_back(Shadow(solid, view).outline);
  return outlines;
}

std::vector<ContourPoint> Contour(std::span<const ConvexHull> solids, const View& view,
                                  double spacing) {
  std::vector<Shadow> shadows;
  for (const ConvexHull& solid : solids) shadows.emplace_back(solid, view);
  std::vector<ContourPoint> contour;
  for (const Shadow& shadow : shadows) {
    for (std::size_t i = 0; i < shadow.outline.size(); ++i) {
      const Vector2& next = shadow.outline[(i + 1) % shadow.outline.size()];
      AddPoints(shadows, {shadow.CornerAt(shadow.outline[i]), shadow.CornerAt(next)}, view, spacing,
                contour);
    }
  }
  return contour;
}

}  // namespace assay::sense
