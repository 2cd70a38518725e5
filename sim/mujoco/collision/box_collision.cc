#include "sim/mujoco/collision/box_collision.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "planner/geometry/coordinates.h"
#include "sim/mujoco/collision/convex_pieces.h"
#include "sim/mujoco/collision/found_contact.h"
#include "sim/mujoco/collision/group_filter.h"
#include "sim/mujoco/collision/inner_faces.h"

namespace assay::mujoco {
namespace {

using geometry::Vector3;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kOutside = 1e-4;  // m
// A face is inside the body if other pieces cover it this far around a point, in metres.
constexpr double kBeside = 2e-5;
// Cosine. A contact's normal must have at least this much of a face's normal to concern the face.
constexpr double kAcross = 0.2;

mjfCollision engine_box_box = nullptr;

Eigen::Map<const Vector3> HalfExtents(const mjModel* m, int geom) {
  return Eigen::Map<const Vector3>(m->geom_size + 3 * geom);
}

Eigen::Map<const RowMajor> Axes(const mjData* d, int geom) {
  return Eigen::Map<const RowMajor>(d->geom_xmat + 9 * geom);
}

Vector3 InGeom(const mjData* d, int geom, const Vector3& p) {
  return Axes(d, geom).transpose() * (p - Eigen::Map<const Vector3>(d->geom_xpos + 3 * geom));
}

Vector3 InWorld(const mjData* d, int geom, const Vector3& local) {
  return Axes(d, geom) * local + Eigen::Map<const Vector3>(d->geom_xpos + 3 * geom);
}

bool LiesIn(const mjModel* m, const mjData* d, int geom, const Vector3& p, double outside) {
  return ((InGeom(d, geom, p).cwiseAbs() - HalfExtents(m, geom)).array() <= outside).all();
}

// Returns whether the point lies in another piece of the geom's body with which `other` collides.
bool IsInAnotherPiece(const mjModel* m, const mjData* d, int geom, int other, const Vector3& p) {
  const int body = m->geom_bodyid[geom];
  const int first = m->body_geomadr[body];
  for (int piece = first; piece < first + m->body_geomnum[body]; ++piece) {
    if (piece == geom || m->geom_type[piece] != mjGEOM_BOX) continue;
    if (!BitsMatch(*m, piece, other)) continue;
    if (LiesIn(m, d, piece, p, kFlush)) return true;
  }
  return false;
}

// Returns whether one of the geom's faces lies against other pieces of its body around p, which is
// in the geom's frame. The face is across `axis`, on the side to which `side` points. Points a
// little beside p must be covered as well.
bool IsCovered(const mjModel* m, const mjData* d, int geom, int other, const Vector3& p,
               Eigen::Index axis, double side) {
  const Vector3 half_extents = HalfExtents(m, geom);
  for (const Eigen::Index across : {(axis + 1) % 3, (axis + 2) % 3}) {
    for (const double beside : {-kBeside, kBeside}) {
      Vector3 q = p;
      q[across] += beside;
      q = q.cwiseMax(-half_extents).cwiseMin(half_extents);
      q[axis] = std::copysign(half_extents[axis] + 3 * kFlush, side);
      if (!IsInAnotherPiece(m, d, geom, other, InWorld(d, geom, q))) return false;
    }
  }
  return true;
}

// Returns whether the way out along a normal goes through a face that is inside of the geom's body.
// Where one piece lies against another, its faces, edges and corners are not part of the body's
// surface.
bool LeadsInside(const mjModel* m, const mjData* d, int geom, int other, const Vector3& p,
                 const Vector3& outward) {
  const Vector3 normal = Axes(d, geom).transpose() * outward;
  const Vector3 local = InGeom(d, geom, p);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double to_face =
        HalfExtents(m, geom)[axis] - std::copysign(1.0, normal[axis]) * local[axis];
    if (std::abs(normal[axis]) < kAcross || to_face > kOutside) continue;
    if (IsCovered(m, d, geom, other, local, axis, normal[axis])) return true;
  }
  return false;
}

// Returns how far it is from a point in a box out of the box in a direction, in metres.
double WayOut(const mjModel* m, const mjData* d, int geom, const Vector3& p,
              const Vector3& direction) {
  const Vector3 along = Axes(d, geom).transpose() * direction;
  const Vector3 local = InGeom(d, geom, p);
  double way = std::numeric_limits<double>::infinity();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double to_face =
        HalfExtents(m, geom)[axis] - std::copysign(1.0, along[axis]) * local[axis];
    if (std::abs(along[axis]) >= kAcross) way = std::min(way, to_face / std::abs(along[axis]));
  }
  return std::max(0.0, way);
}

// The engine gives half of the boxes' common depth for most contacts, and all of it for the others.
void TakeHalfOfDepth(const mjModel* m, const mjData* d, int g1, int g2, mjContact& contact) {
  const Eigen::Map<const Vector3> p(contact.pos);
  const Eigen::Map<const Vector3> normal(contact.frame);
  const double common = WayOut(m, d, g1, p, normal) + WayOut(m, d, g2, p, -normal);
  if (-contact.dist > 0.75 * common) contact.dist /= 2;
}

// The contact's normal points from the first geom to the second.
bool IsInside(const mjModel* m, const mjData* d, int g1, int g2, const mjContact& contact) {
  const Eigen::Map<const Vector3> p(contact.pos);
  const Eigen::Map<const Vector3> normal(contact.frame);
  if (const ConvexPieces* const pieces = CollidingPieces::Present()) {
    return IsInsideBody(*m, *d, *pieces, {g1, g2, p, normal, contact.dist});
  }
  return LeadsInside(m, d, g1, g2, p, normal) || LeadsInside(m, d, g2, g1, p, -normal);
}

int CheckedBoxBox(const mjModel* m, const mjData* d, mjContact* contacts, int g1, int g2,
                  mjtNum margin) {
  const int count = engine_box_box(m, d, contacts, g1, g2, margin);
  mjContact* const end = std::remove_if(contacts, contacts + count, [&](const mjContact& contact) {
    const Eigen::Map<const Vector3> p(contact.pos);
    return !LiesIn(m, d, g1, p, kOutside) || !LiesIn(m, d, g2, p, kOutside) ||
           IsFoundAlready(*m, *d, g1, g2, contact) || IsInside(m, d, g1, g2, contact);
  });
  std::for_each(contacts, end, [&](mjContact& contact) { TakeHalfOfDepth(m, d, g1, g2, contact); });
  return static_cast<int>(end - contacts);
}

}  // namespace

void CheckBoxCollisions() {
  static std::once_flag once;
  std::call_once(once, [] {
    engine_box_box = mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX];
    mjCOLLISIONFUNC[mjGEOM_BOX][mjGEOM_BOX] = CheckedBoxBox;
  });
}

}  // namespace assay::mujoco
