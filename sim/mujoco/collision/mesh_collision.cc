#include "sim/mujoco/collision/mesh_collision.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <mutex>

#include "sim/mujoco/collision/body_contacts.h"
#include "sim/mujoco/collision/convex_pieces.h"
#include "sim/mujoco/collision/found_contact.h"

namespace assay::mujoco {
namespace {

// The share of the depth that the engine gets, as for boxes (box_collision.h).
constexpr double kShareOfDepth = 0.5;

std::array<mjfCollision, mjNGEOMTYPES> engine_with_mesh;  // by the type of the first geom

// Returns the contact with the normal away from `g1`. The engine completes the frame, of which the
// normal is the first row.
mjContact EngineContact(const PieceContact& found, int g1) {
  mjContact contact{};
  mju_copy3(contact.pos, found.at.data());
  mju_scl3(contact.frame, found.normal.data(), found.geom1 == g1 ? 1 : -1);
  contact.dist = kShareOfDepth * found.separation;
  return contact;
}

// Returns the contacts of the bodies of two geoms. They are computed once in each pass of the
// engine's collisions.
const std::vector<PieceContact>& ContactsOfBodiesOf(const mjModel& m, const mjData& d,
                                                    const ConvexPieces& pieces, int g1, int g2) {
  const auto [body1, body2] = std::minmax({m.geom_bodyid[g1], m.geom_bodyid[g2]});
  const auto [found, is_new] = CollidingPieces::Contacts().try_emplace({body1, body2});
  if (is_new) found->second = ContactsOfBodies(m, d, pieces, body1, body2);
  return found->second;
}

int CollideWithMesh(const mjModel* m, const mjData* d, mjContact* contacts, int g1, int g2,
                    mjtNum margin) {
  const ConvexPieces* const pieces = CollidingPieces::Present();
  if (pieces == nullptr) return engine_with_mesh[m->geom_type[g1]](m, d, contacts, g1, g2, margin);
  int count = 0;
  for (const PieceContact& found : ContactsOfBodiesOf(*m, *d, *pieces, g1, g2)) {
    if (std::minmax({found.geom1, found.geom2}) != std::minmax({g1, g2})) continue;
    const mjContact contact = EngineContact(found, g1);
    if (!IsFoundAlready(*m, *d, g1, g2, contact)) contacts[count++] = contact;
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
