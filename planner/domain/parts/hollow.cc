#include "planner/domain/parts/hollow.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "planner/domain/parts/exposed_faces.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/polygon.h"

namespace assay::domain {
namespace {

using geometry::ConvexHull;

constexpr double kSameSide = 1e-6;  // greatest difference of unit vectors that should be equal

// Returns the face in which a pocket ends on the side that looks in a direction: an end of its
// solid, or the floor of a wider pocket. Returns None if the pocket ends inside the part, or if the
// pockets leave nothing of this face.
FaceId EndOf(const PartModel& model, const Hollow& hollow, const Vector3& direction) {
  return FindFace(model.faces(), direction, FarthestAlong(hollow.clipped, direction));
}

// Returns the hull of the cross-sections of solids just inside a face, in the x and y of the face's
// frame.
geometry::Polygon SectionAt(const Face& face, std::span<const ConvexHull> solids) {
  constexpr double kInside = 1e-7;  // metres
  std::vector<Vector2> corners;
  for (const ConvexHull& solid : solids) {
    std::ranges::copy(CrossSection(solid, face, -kInside), std::back_inserter(corners));
  }
  return geometry::Hull2(corners);
}

// Returns whether a side belongs to a pocket and not to the solid that clips it, and moves with the
// clearance.
bool MovesWithClearance(const PartSolids::Pocket& pocket, const Side& side) {
  const auto is_same = [&](const Side& own) {
    return std::abs(own.offset - side.offset) < kRounding;
  };
  return std::ranges::any_of(
             pocket.moved_sides,
             [&](const Vector3& normal) { return (normal - side.normal).norm() < kSameSide; }) &&
         std::ranges::any_of(SidesTowards(pocket.whole, side.normal), is_same);
}

}  // namespace

Hollow HollowOf(const PartSolids& solids, const PartSolids::Pocket& pocket) {
  return {solids.SolidOf(pocket), pocket, solids.Clipped(pocket)};
}

std::optional<Mouth> FindMouth(const PartModel& model, std::span<const Hollow> hollows,
                               const Vector3& direction) {
  const Hollow& first = hollows.front();
  const FaceId id = EndOf(model, first, direction);
  if (id.IsNone()) return std::nullopt;
  const Face& face = model.faces()[id.index()];
  geometry::Polygon outline = SectionAt(face, first.clipped);
  for (const Hollow& other : hollows.subspan(1)) {
    if (EndOf(model, other, direction) != id) return std::nullopt;
    outline = geometry::Intersection(outline, SectionAt(face, other.pocket.whole));
  }
  if (outline.empty() || !IsOpen(face, outline, model.pieces())) return std::nullopt;
  return Mouth{id, std::move(outline)};
}

Vector3 CenterAt(const Face& face, const Hollow& hollow) {
  const Vector2 center = geometry::Centroid(SectionAt(face, hollow.clipped));
  return face.X_PartFace * Vector3(center.x(), center.y(), 0);
}

std::vector<Wall> WallsOf(const PartModel& model, const Hollow& hollow) {
  std::vector<Wall> walls;
  for (const ConvexHull& clipped : hollow.clipped) {
    for (Side& side : SidesOf(clipped)) {
      const bool moves = MovesWithClearance(hollow.pocket, side);
      side.normal = -side.normal;
      side.offset = -side.offset;
      const FaceId id = ExposedFaceOf(model.faces(), side);
      if (id.IsNone()) continue;
      walls.push_back({id, OnFace(model.faces()[id.index()], side.corners), moves});
    }
  }
  return walls;
}

}  // namespace assay::domain
