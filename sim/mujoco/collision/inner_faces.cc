#include "sim/mujoco/collision/inner_faces.h"

#include <mujoco/mujoco.h>

#include <algorithm>

#include "planner/geometry/coordinates.h"
#include "sim/mujoco/collision/group_filter.h"

namespace assay::mujoco {
namespace {

using geometry::ContactSolid;
using geometry::Facet;
using geometry::Plane;
using geometry::Vector3;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// The greatest distance, in metres, between a contact and a facet that the contact concerns.
constexpr double kNearFacet = 1e-4;
// A facet is inside the body at a point if other pieces cover the facet around the point, up to
// this distance from it. In metres.
constexpr double kAroundPoint = 2e-5;
// The least cosine of the angle between the normal of a contact and the normal of a facet that the
// contact concerns.
constexpr double kThroughFacet = 0.2;

// A simulation's geoms at the present time.
struct PlacedPieces {
  const mjModel& m;
  const mjData& d;
  const ConvexPieces& pieces;

  Eigen::Map<const RowMajor> Axes(int geom) const {
    return Eigen::Map<const RowMajor>(d.geom_xmat + 9 * geom);
  }
  Eigen::Map<const Vector3> Origin(int geom) const {
    return Eigen::Map<const Vector3>(d.geom_xpos + 3 * geom);
  }
  Vector3 InGeom(int geom, const Vector3& p) const {
    return Axes(geom).transpose() * (p - Origin(geom));
  }
  Vector3 InWorld(int geom, const Vector3& local) const {
    return Axes(geom) * local + Origin(geom);
  }
  bool LiesIn(int geom, const Vector3& p) const {
    const Vector3 local = InGeom(geom, p);
    return std::ranges::all_of(pieces.SolidOf(geom)->hull.facets, [&](const Facet& facet) {
      return facet.normal.dot(local) <= facet.offset + kFlush;
    });
  }
};

// Projects `p` onto the plane of the facet, and returns the projected point. If this point is
// outside of the facet, it is first moved to the facet's border.
Vector3 OnFacet(const ContactSolid& solid, int facet, Vector3 p) {
  p -= solid.PlaneOf(facet).Above(p) * solid.hull.facets[facet].normal;
  for (const Plane& border : solid.borders[facet]) {
    p -= std::max(0.0, border.Above(p)) * border.normal;
  }
  return p;
}

// Returns whether the pieces that collide with `other` cover the facet around the point `p`. The
// point is given in the geom's frame. Four points a little beside it must be covered.
bool IsCoveredFacet(const PlacedPieces& placed, int geom, const ConvexPieces::CoveredFacet& covered,
                    int other, const Vector3& p) {
  const ContactSolid& solid = *placed.pieces.SolidOf(geom);
  const Vector3& normal = solid.hull.facets[covered.facet].normal;
  const Vector3& aside = solid.borders[covered.facet].front().normal;
  const Vector3 along = normal.cross(aside);
  for (const Vector3& beside : {aside, Vector3(-aside), along, Vector3(-along)}) {
    const Vector3 on_facet = OnFacet(solid, covered.facet, p + kAroundPoint * beside);
    const Vector3 above = placed.InWorld(geom, on_facet + 3 * kFlush * normal);
    const auto covers = [&](int piece) {
      return BitsMatch(placed.m, piece, other) && placed.LiesIn(piece, above);
    };
    if (std::ranges::none_of(covered.by, covers)) return false;
  }
  return true;
}

bool LeadsThroughCover(const PlacedPieces& placed, int geom, int other, const Vector3& p,
                       const Vector3& outward) {
  const Vector3 local = placed.InGeom(geom, p);
  const Vector3 direction = placed.Axes(geom).transpose() * outward;
  return std::ranges::any_of(
      placed.pieces.CoveredFacets(geom), [&](const ConvexPieces::CoveredFacet& covered) {
        const Plane plane = placed.pieces.SolidOf(geom)->PlaneOf(covered.facet);
        return plane.normal.dot(direction) >= kThroughFacet && plane.Above(local) >= -kNearFacet &&
               IsCoveredFacet(placed, geom, covered, other, local);
      });
}

}  // namespace

bool IsInsideBody(const mjModel& m, const mjData& d, const ConvexPieces& pieces,
                  const PieceContact& contact) {
  const PlacedPieces placed{m, d, pieces};
  return LeadsThroughCover(placed, contact.geom1, contact.geom2, contact.at, contact.normal) ||
         LeadsThroughCover(placed, contact.geom2, contact.geom1, contact.at, -contact.normal);
}

}  // namespace assay::mujoco
