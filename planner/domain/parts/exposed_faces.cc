#include "planner/domain/parts/exposed_faces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "planner/base/check.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/planar_region.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/shadow.h"

namespace assay::domain {
namespace {

using geometry::ConvexHull;
using geometry::Polygon;

// Unit normals whose difference is shorter than this count as equal. For small angles this is the
// angle in radians.
constexpr double kSameNormal = 1e-6;
constexpr double kSamePlane = 5e-8;  // metres
// At this height above a plane, in metres, solids are tested for what they cover: more than
// rounding, less than any intended gap.
constexpr double kProbe = 1e-7;
// The least breadth of a patch of a face, in metres. The section of a leaning solid at the height
// kProbe is a little smaller than at the plane. The narrow strip that is left belongs to no face.
constexpr double kNarrowest = 1e-5;

bool InPlane(const Face& face, const Vector3& normal, double offset) {
  return (face.normal - normal).norm() < kSameNormal && std::abs(face.offset - offset) < kSamePlane;
}

Face EmptyFace(const Side& side) {
  Face face;
  face.normal = side.normal;
  face.offset = side.offset;
  face.X_PartFace = FrameAlong(side.offset * side.normal, side.normal);
  return face;
}

// A plane in which sides of solids lie, with the outlines of all these sides.
struct Plane {
  Face face;
  std::vector<Polygon> sides;
};

std::vector<Plane> PlanesOf(std::span<const ConvexHull> solids) {
  std::vector<Plane> planes;
  for (const ConvexHull& solid : solids) {
    for (const Side& side : SidesOf(solid)) {
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

// Returns a box about the sides of a plane and what is next to them, in the part's axes.
Eigen::AlignedBox3d BoxAbout(const Plane& plane) {
  constexpr double kNext = 1e-6;  // metres, more than kProbe
  Eigen::AlignedBox3d box;
  for (const Polygon& side : plane.sides) {
    for (const Vector2& p : side) box.extend(plane.face.X_PartFace * Vector3(p.x(), p.y(), 0));
  }
  return {box.min().array() - kNext, box.max().array() + kNext};
}

bool Reaches(const ConvexHull& solid, const Eigen::AlignedBox3d& box) {
  Eigen::AlignedBox3d reach;
  for (const Vector3& vertex : solid.vertices) reach.extend(vertex);
  return reach.intersects(box);
}

// Returns the union of the sides without the areas that solids cover.
geometry::Patches Exposed(const Plane& plane, std::span<const ConvexHull> solids) {
  const Eigen::AlignedBox3d near = BoxAbout(plane);
  std::vector<Polygon> covers;
  for (const ConvexHull& solid : solids) {
    if (!Reaches(solid, near)) continue;
    Polygon cover = CrossSection(solid, plane.face, kProbe);
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

std::vector<Side> SidesOf(const ConvexHull& solid) {
  std::vector<Side> sides;
  for (const geometry::Facet* const facet : FacetsByAxis(solid)) {
    Side& side = sides.emplace_back(facet->normal, facet->offset);
    for (const int vertex : facet->loop) side.corners.push_back(solid.vertices[vertex]);
  }
  return sides;
}

std::vector<Side> SidesTowards(std::span<const ConvexHull> solids, const Vector3& direction) {
  std::vector<Side> towards;
  for (const ConvexHull& solid : solids) {
    for (Side& side : SidesOf(solid)) {
      if ((side.normal - direction).norm() < kSameNormal) towards.push_back(std::move(side));
    }
  }
  std::ranges::stable_sort(towards, std::ranges::greater(), &Side::offset);
  return towards;
}

double FarthestAlong(std::span<const ConvexHull> solids, const Vector3& direction) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const ConvexHull& solid : solids) {
    farthest = std::max(farthest, GreatestAlong(solid, direction));
  }
  return farthest;
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

bool IsExposed(const Side& side, std::span<const ConvexHull> solids) {
  Plane plane = {EmptyFace(side), {}};
  plane.sides.push_back(OnFace(plane.face, side.corners));
  return !Exposed(plane, solids).empty();
}

std::vector<Face> ExposedFaces(std::span<const ConvexHull> solids) {
  std::vector<Face> faces;
  for (Plane& plane : PlanesOf(solids)) {
    plane.face.patches = Exposed(plane, solids);
    if (!plane.face.patches.empty()) faces.push_back(std::move(plane.face));
  }
  return faces;
}

FaceId ExposedFaceOf(std::span<const Face> faces, const Side& side) {
  const FaceId id = FindFace(faces, side.normal, side.offset);
  if (id.IsNone()) return id;
  const Face& face = faces[id.index()];
  return geometry::Meets(face.patches, OnFace(face, side.corners)) ? id : FaceId::None();
}

Polygon CrossSection(const ConvexHull& solid, const Face& face, double height) {
  return geometry::ShadowBetween(Transformed(solid, face.X_PartFace.inverse()), height, height);
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

bool IsOpen(const Face& face, const Polygon& outline, std::span<const ConvexHull> solids) {
  return std::ranges::none_of(solids, [&](const ConvexHull& solid) {
    return geometry::Meets({outline}, CrossSection(solid, face, kProbe)) ||
           geometry::Meets({outline}, CrossSection(solid, face, -kProbe));
  });
}

}  // namespace assay::domain
