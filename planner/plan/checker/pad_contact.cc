#include "planner/plan/checker/pad_contact.h"

#include <algorithm>
#include <cmath>

#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"

namespace assay::plan {
namespace {

using domain::Face;
using domain::FaceId;
using geometry::Polygon;
using geometry::Vector2;
using geometry::Vector3;

constexpr int kPointsPerSide = 17;    // points of the grid per side: 1 mm apart on a pad of 16 mm
constexpr double kProbe = 1e-5;       // distance of the tested points from the surface, metres
constexpr double kSeam = 1e-6;        // metres, between pieces of one solid, and around rims
constexpr double kNearCorner = 0.9;   // share of the way from the middle to a corner
constexpr double kSameNormal = 1e-6;  // 1 - cosine, of normals that count as equal

PadContact ContactOf(const Hold& hold, const Vector2& half, double side) {
  PadContact contact{.finger = side > 0 ? "left" : "right",
                     .normal = side * hold.X_PartTool.linear().col(1),
                     .points = {}};
  for (int i = 0; i < kPointsPerSide; ++i) {
    for (int j = 0; j < kPointsPerSide; ++j) {
      const Vector2 at = Vector2(i, j) * 2 / (kPointsPerSide - 1) - Vector2::Ones();
      const Vector2 p = at.cwiseProduct(half - Vector2::Constant(kSeam));
      contact.points.push_back(hold.X_PartTool * Vector3(p.x(), side * hold.width / 2, p.y()));
    }
  }
  return contact;
}

bool IsInAny(std::span<const geometry::ConvexHull> solids, const Vector3& p, double tolerance) {
  return std::ranges::any_of(
      solids, [&](const geometry::ConvexHull& solid) { return Contains(solid, p, tolerance); });
}

bool IsOnSurface(std::span<const geometry::ConvexHull> part, const Vector3& p,
                 const Vector3& normal) {
  return IsInAny(part, p - kProbe * normal, kSeam) && !IsInAny(part, p + kProbe * normal, 0);
}

// Appends points of a facet under the pad: the middle of what the pad covers of it, and points near
// the corners of that.
void AppendPointsOn(const geometry::ConvexHull& piece, const geometry::Facet& facet,
                    const PadContact& pad, std::vector<Vector3>& points) {
  const Vector3& corner = pad.points.front();
  if (facet.normal.dot(pad.normal) < 1 - kSameNormal) return;
  if (std::abs(facet.offset - facet.normal.dot(corner)) > kProbe) return;
  const Vector3 x = pad.points[kPointsPerSide * (kPointsPerSide - 1)] - corner;
  const Vector3 z = pad.points[kPointsPerSide - 1] - corner;
  std::vector<Vector2> outline;  // in shares of the pad's sides
  for (const int vertex : facet.loop) {
    const Vector3 p = piece.vertices[static_cast<std::size_t>(vertex)] - corner;
    outline.emplace_back(p.dot(x) / x.squaredNorm(), p.dot(z) / z.squaredNorm());
  }
  const Polygon covered =
      geometry::Intersection(geometry::Hull2(outline), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  if (covered.empty()) return;
  const Vector2 middle = geometry::Centroid(covered);
  std::vector<Vector2> on_facet = {middle};
  for (const Vector2& p : covered) on_facet.push_back(kNearCorner * p + (1 - kNearCorner) * middle);
  for (const Vector2& p : on_facet) points.push_back(corner + p.x() * x + p.y() * z);
}

// Returns whether p is inside a convex polygon, farther than kSeam from its rim.
bool IsInside(const Polygon& polygon, const Vector2& p) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vector2 to_p = p - polygon[i];
    if (!(edge.x() * to_p.y() - edge.y() * to_p.x() > kSeam * edge.norm())) return false;
  }
  return polygon.size() >= 3;
}

// The pad's outline, in the coordinates of a face.
struct Footprint {
  std::vector<Vector2> points;
  Polygon outline;
};

Footprint FootprintOn(const Face& face, const PadContact& contact) {
  Footprint footprint;
  const Pose X_FacePart = face.X_PartFace.inverse();
  for (const Vector3& p : contact.points) footprint.points.push_back((X_FacePart * p).head<2>());
  const std::size_t last = kPointsPerSide - 1;
  const auto at = [&](std::size_t i, std::size_t j) {
    return footprint.points[i * kPointsPerSide + j];
  };
  footprint.outline = {at(0, 0), at(last, 0), at(last, last), at(0, last)};
  const Vector2 u = footprint.outline[1] - footprint.outline[0];
  const Vector2 v = footprint.outline[3] - footprint.outline[0];
  if (u.x() * v.y() - u.y() * v.x() < 0) std::ranges::reverse(footprint.outline);
  return footprint;
}

bool IsOnFace(const PadContact& contact, const Face& face) {
  return contact.normal.dot(face.normal) > 1 - kSameNormal &&
         std::abs(face.normal.dot(contact.points.front()) - face.offset) < kProbe;
}

bool CoversRegion(const PadContact& contact, const Face& face, const Polygon& region) {
  if (!IsOnFace(contact, face)) return false;
  const Footprint pad = FootprintOn(face, contact);
  return std::ranges::any_of(pad.points, [&](const auto& p) { return IsInside(region, p); }) ||
         std::ranges::any_of(region, [&](const auto& p) { return IsInside(pad.outline, p); });
}

bool LiesOnTable(const Face& face, const Pose& X_WorldPart) {
  const Vector3 normal = X_WorldPart.linear() * face.normal;
  const double height = (X_WorldPart * Vector3(face.offset * face.normal)).z();
  return normal.z() < -1 + kSameNormal && std::abs(height) < kProbe;
}

}  // namespace

std::array<PadContact, 2> PadContactsOf(const Hold& hold, const Vector2& pad_half_extents) {
  return {ContactOf(hold, pad_half_extents, 1), ContactOf(hold, pad_half_extents, -1)};
}

int PointsOfTouch(const std::array<PadContact, 2>& pads,
                  std::span<const geometry::ConvexHull> part) {
  const auto& [left, right] = pads;
  const Vector3 across = right.points.front() - left.points.front();
  std::vector<Vector3> examined = left.points;
  for (const geometry::ConvexHull& piece : part) {
    for (const geometry::Facet& facet : piece.facets) {
      AppendPointsOn(piece, facet, left, examined);
    }
  }
  return static_cast<int>(std::ranges::count_if(examined, [&](const Vector3& p) {
    return IsOnSurface(part, p, left.normal) && IsOnSurface(part, p + across, right.normal);
  }));
}

bool Covers(const PadContact& contact, const domain::PartModel& part,
            const domain::Feature& feature) {
  const auto on_face = [&](FaceId id) {
    const Face& face = part.faces()[id.index()];
    return std::ranges::any_of(
        face.patches, [&](const Polygon& patch) { return CoversRegion(contact, face, patch); });
  };
  const auto on_mouth = [&](const domain::Mouth& mouth) {
    return CoversRegion(contact, part.faces()[mouth.face.index()], mouth.outline);
  };
  return std::ranges::any_of(feature.faces, on_face) ||
         std::ranges::any_of(feature.mouths, on_mouth);
}

bool IsOnTable(const domain::PartModel& part, const domain::Feature& feature,
               const Pose& X_WorldPart) {
  const auto face_is = [&](FaceId id) {
    return LiesOnTable(part.faces()[id.index()], X_WorldPart);
  };
  const auto mouth_is = [&](const domain::Mouth& mouth) { return face_is(mouth.face); };
  return std::ranges::any_of(feature.faces, face_is) ||
         std::ranges::any_of(feature.mouths, mouth_is);
}

}  // namespace assay::plan
