#include "planner/domain/parts/exposed_faces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "planner/base/check.h"
#include "planner/geometry/box_shadow.h"
#include "planner/geometry/planar_region.h"

namespace assay::domain {
namespace {

using geometry::Box;
using geometry::Polygon;

// Unit normals whose difference is shorter than this count as equal. For small angles this is the
// angle in radians.
constexpr double kSameNormal = 1e-6;
constexpr double kSamePlane = 5e-8;  // metres
// At this height above a plane, in metres, boxes are tested for what they cover: more than
// rounding, less than any intended gap.
constexpr double kProbe = 1e-7;
// The least breadth of a patch of a face, in metres. The section of a leaning box at the height
// kProbe is a little smaller than at the plane. The narrow strip that is left belongs to no face.
constexpr double kNarrowest = 1e-5;

bool InPlane(const Face& face, const Vector3& normal, double offset) {
  return (face.normal - normal).norm() < kSameNormal && std::abs(face.offset - offset) < kSamePlane;
}

Polygon CrossSection(const Box& box, const Face& face, double height) {
  return geometry::ShadowBetween(box.Transformed(face.X_PartFace.inverse()), height, height);
}

Face EmptyFace(const Side& side) {
  Face face;
  face.normal = side.normal;
  face.offset = side.offset;
  face.X_PartFace = FrameAlong(side.offset * side.normal, side.normal);
  return face;
}

// A plane in which sides of boxes lie, with the rectangles of all these sides.
struct Plane {
  Face face;
  std::vector<Polygon> sides;
};

std::vector<Plane> PlanesOf(std::span<const Box> boxes) {
  std::vector<Plane> planes;
  for (const Box& box : boxes) {
    for (const Side& side : SidesOf(box)) {
      auto plane = std::ranges::find_if(
          planes, [&](const Plane& p) { return InPlane(p.face, side.normal, side.offset); });
      if (plane == planes.end()) plane = planes.insert(plane, {EmptyFace(side), {}});
      plane->sides.push_back(OnFace(plane->face, side.corners));
    }
  }
  return planes;
}

// Returns the breadth of a polygon: the least distance of two parallel lines with the polygon
// between them.
double Breadth(const Polygon& polygon) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vector2 across = Vector2(-edge.y(), edge.x()).normalized();
    double farthest = 0;
    for (const Vector2& p : polygon) farthest = std::max(farthest, across.dot(p - polygon[i]));
    least = std::min(least, farthest);
  }
  return least;
}

// Returns the union of the sides without the areas that boxes cover.
geometry::Patches Exposed(const Plane& plane, std::span<const Box> boxes) {
  std::vector<Polygon> covers;
  for (const Box& box : boxes) {
    Polygon cover = CrossSection(box, plane.face, kProbe);
    if (cover.size() >= 3) covers.push_back(std::move(cover));
  }
  geometry::Patches exposed;
  for (const Polygon& side : plane.sides) {
    geometry::Patches fresh = {side};
    for (const Polygon& cover : covers) fresh = geometry::Without(fresh, cover);
    for (const Polygon& earlier : plane.sides) {
      if (&earlier == &side) break;
      fresh = geometry::Without(fresh, earlier);
    }
    const auto is_broad = [](const Polygon& patch) { return Breadth(patch) > kNarrowest; };
    std::ranges::copy_if(fresh, std::back_inserter(exposed), is_broad);
  }
  return exposed;
}

}  // namespace

std::array<Side, 6> SidesOf(const Box& box) {
  // Bit k of the index is the side along axis k.
  const std::array<Vector3, 8> corners = box.Corners();
  std::array<Side, 6> sides;
  for (int i = 0; i < 6; ++i) {
    const int axis = i / 2;
    const int bit = i % 2;
    Side& side = sides[i];
    side.normal = (bit == 1 ? 1 : -1) * box.X_FrameBox.linear().col(axis);
    int count = 0;
    for (int corner = 0; corner < 8; ++corner) {
      if (((corner >> axis) & 1) == bit) side.corners[count++] = corners[corner];
    }
    side.offset = side.normal.dot(side.corners[0]);
  }
  return sides;
}

Pose FrameAlong(const Vector3& origin, const Vector3& z) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(z[i]) < std::abs(z[axis]) - kRounding) axis = i;
  }
  const Vector3 along = Vector3::Unit(axis);
  const Vector3 x = (along - along.dot(z) * z).normalized();
  return geometry::PoseFromColumns(x, z.cross(x), z, origin);
}

std::vector<Face> ExposedFaces(std::span<const Box> boxes) {
  std::vector<Face> faces;
  for (Plane& plane : PlanesOf(boxes)) {
    plane.face.patches = Exposed(plane, boxes);
    if (!plane.face.patches.empty()) faces.push_back(std::move(plane.face));
  }
  return faces;
}

FaceId FindFace(std::span<const Face> faces, const Vector3& normal, double offset) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (InPlane(faces[i], normal, offset)) return FaceId(i);
  }
  return FaceId::None();
}

Polygon OnFace(const Face& face, std::span<const Vector3> points) {
  const Pose X_FacePart = face.X_PartFace.inverse();
  std::vector<Vector2> seen;
  for (const Vector3& p : points) seen.push_back((X_FacePart * p).head<2>());
  return geometry::Hull2(seen);
}

bool IsOpen(const Face& face, const Polygon& outline, std::span<const Box> boxes) {
  return std::ranges::none_of(boxes, [&](const Box& box) {
    return geometry::Meets({outline}, CrossSection(box, face, kProbe)) ||
           geometry::Meets({outline}, CrossSection(box, face, -kProbe));
  });
}

}  // namespace assay::domain
