#include "sim/mujoco/mesh_collision.h"

#include <mujoco/mujoco.h>

#include <array>
#include <mutex>
#include <optional>

#include "planner/geometry/contact/contact_manifold.h"
#include "sim/mujoco/convex_pieces.h"
#include "sim/mujoco/found_contact.h"
#include "sim/mujoco/inner_faces.h"

namespace assay::mujoco {
namespace {

using geometry::ContactManifold;
using geometry::ContactSolid;
using geometry::Pose;
using geometry::Vector3;

static_assert(geometry::kMostContactPoints <= mjMAXCONPAIR);

std::array<mjfCollision, mjNGEOMTYPES> engine_with_mesh;  // by the type of the first geom

Pose GeomPose(const mjData& d, int geom) {
  Pose X = Pose::Identity();
  X.translation() = Eigen::Map<const Vector3>(d.geom_xpos + 3 * geom);
  X.linear() =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(d.geom_xmat + 9 * geom);
  return X;
}

std::optional<ContactManifold> Manifold(const mjModel& m, const mjData& d,
                                        const ConvexPieces& pieces, int g1, int g2, double margin) {
  const Pose X_WorldSecond = GeomPose(d, g2);
  const ContactSolid& second = *pieces.SolidOf(g2);
  const Pose X_WorldFirst = GeomPose(d, g1);
  if (m.geom_type[g1] == mjGEOM_PLANE) {
    const Vector3 normal = X_WorldFirst.linear().col(2);
    const geometry::Plane plane{normal, normal.dot(X_WorldFirst.translation())};
    return geometry::ContactBetween(plane, second, X_WorldSecond, margin);
  }
  return geometry::ContactBetween(*pieces.SolidOf(g1), X_WorldFirst, second, X_WorldSecond, margin);
}

// The engine completes the frame, of which the normal is the first row.
mjContact EngineContact(const ContactManifold::Point& point, const Vector3& normal) {
  mjContact contact{};
  mju_copy3(contact.pos, point.at.data());
  mju_copy3(contact.frame, normal.data());
  contact.dist = point.separation;
  return contact;
}

int CollideWithMesh(const mjModel* m, const mjData* d, mjContact* contacts, int g1, int g2,
                    mjtNum margin) {
  const ConvexPieces* const pieces = CollidingPieces::Present();
  if (pieces == nullptr) return engine_with_mesh[m->geom_type[g1]](m, d, contacts, g1, g2, margin);
  const std::optional<ContactManifold> manifold = Manifold(*m, *d, *pieces, g1, g2, margin);
  if (!manifold) return 0;
  int count = 0;
  for (const ContactManifold::Point& point : manifold->points) {
    const mjContact contact = EngineContact(point, manifold->normal);
    if (IsFoundAlready(*m, *d, g1, g2, contact)) continue;
    if (IsInsideBody(*m, *d, *pieces, g1, g2, contact)) continue;
    contacts[count++] = contact;
  }
  return count;
}

}  // namespace

void ReplaceMeshCollisions() {
  static std::once_flag once;
  std::call_once(once, [] {
    for (const int type : {mjGEOM_PLANE, mjGEOM_BOX, mjGEOM_MESH}) {
      engine_with_mesh[type] = mjCOLLISIONFUNC[type][mjGEOM_MESH];
      mjCOLLISIONFUNC[type][mjGEOM_MESH] = CollideWithMesh;
    }
  });
}

}  // namespace assay::mujoco
