#include "planner/domain/grasps/face_pair.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <span>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"

namespace assay::domain {
namespace {

using geometry::Polygon;

// Normals count as opposite if they deviate from opposite directions by at most this angle, in
// radians.
constexpr double kOpposite = 0.1 * std::numbers::pi / 180;
constexpr double kApart = 1e-7;  // metres; faces that are nearer to each other are no pair

geometry::Patches WallsIn(const PartModel& part, FaceId id) {
  geometry::Patches walls;
  for (const Feature& feature : part.features()) {
    for (const Wall& wall : feature.walls) {
      if (wall.face == id) walls.push_back(wall.outline);
    }
  }
  return walls;
}

geometry::Patches Graspable(const PartModel& part, FaceId id) {
  geometry::Patches patches = part.faces()[id.index()].patches;
  for (const Polygon& wall : WallsIn(part, id)) patches = geometry::Without(patches, wall);
  return patches;
}

// Returns patches of one face in the coordinates of the opposite face.
geometry::Patches SeenFrom(const Pose& X_FirstSecond, const geometry::Patches& patches) {
  geometry::Patches seen;
  for (const Polygon& patch : patches) {
    std::vector<Vector2> corners;
    for (const Vector2& p : patch) {
      corners.push_back((X_FirstSecond * Vector3(p.x(), p.y(), 0)).head<2>());
    }
    seen.push_back(geometry::Hull2(corners));
  }
  return seen;
}

std::optional<FacePair> PairUp(const PartModel& part, std::span<const Face> graspable, FaceId a,
                               FaceId b, double widest) {
  const Face& first = graspable[a.index()];
  const Face& second = graspable[b.index()];
  if ((first.normal + second.normal).norm() >= kOpposite) return std::nullopt;
  const Pose X_FirstSecond = first.X_PartFace.inverse() * second.X_PartFace;
  const double width = -X_FirstSecond.translation().z();
  if (width <= kApart || width > widest + kApart) return std::nullopt;
  geometry::Patches region =
      geometry::Common(first.patches, SeenFrom(X_FirstSecond, second.patches));
  if (region.empty()) return std::nullopt;
  geometry::Patches walls = WallsIn(part, a);
  std::ranges::copy(SeenFrom(X_FirstSecond, WallsIn(part, b)), std::back_inserter(walls));
  const Pose X_PartMiddle = first.X_PartFace * geometry::Translation(0, 0, -width / 2);
  return FacePair{a, b, width, X_PartMiddle, std::move(region), std::move(walls)};
}

// Returns the direction of the longest edge of a polygon.
Vector2 LongestEdgeOf(const Polygon& polygon) {
  Vector2 longest = Vector2::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (edge.norm() > longest.norm()) longest = edge;
  }
  return longest.normalized();
}

}  // namespace

std::vector<FacePair> PairsOf(const PartModel& part, double widest) {
  std::vector<Face> faces = part.faces();
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i].patches = Graspable(part, FaceId(i));
  std::vector<FacePair> pairs;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size(); ++j) {
      std::optional<FacePair> pair = PairUp(part, faces, FaceId(i), FaceId(j), widest);
      if (pair) pairs.push_back(*std::move(pair));
    }
  }
  return pairs;
}

// The faces of a prism are rectangles, and the axis is along one of their sides.
std::optional<RoundSide> RoundSideOf(const PartModel& part, const FacePair& pair) {
  const Vector2 longest = LongestEdgeOf(geometry::Hull(pair.region));
  const Vector2 middle = geometry::Centroid(pair.region);
  for (const Vector2& along : {longest, Vector2(-longest.y(), longest.x())}) {
    const Pose X_MiddleAxis = geometry::PoseFromColumns(
        Vector3::UnitZ(), Vector3(-along.y(), along.x(), 0), Vector3(-along.x(), -along.y(), 0),
        Vector3(middle.x(), middle.y(), 0));
    auto side = RoundSideAbout(part, pair.X_PartMiddle * X_MiddleAxis, pair.width / 2);
    if (side) return side;
  }
  return std::nullopt;
}

}  // namespace assay::domain
