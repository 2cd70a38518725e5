#include "sim/mujoco/box_collision.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <mutex>

#include "planner/geometry/pose.h"

namespace assay::mujoco {
namespace {

using geometry::Vector3;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kOutside = 1e-4;    // m
constexpr double kSamePlace = 1e-6;  // m
constexpr double kSameNormal = 1 - 1e-9;

mjfCollision engine_box_box = nullptr;

bool LiesIn(const mjModel* m, const mjData* d, int geom, const Vector3& p) {
  const Eigen::Map<const Vector3> center(d->geom_xpos + 3 * geom);
  const Eigen::Map<const RowMajor> R_WorldGeom(d->geom_xmat + 9 * geom);
  const Eigen::Map<const Vector3> half_extents(m->geom_size + 3 * geom);
  const Vector3 local = R_WorldGeom.transpose() * (p - center);
  return ((local.cwiseAbs() - half_extents).array() <= kOutside).all();
}

// Whether the engine gives contacts of both geoms the same parameters, and moves both as one.
bool AreOneBody(const mjModel* m, int a, int b) {
  return m->geom_bodyid[a] == m->geom_bodyid[b] && m->geom_condim[a] == m->geom_condim[b] &&
         std::equal(m->geom_friction + 3 * a, m->geom_friction + 3 * a + 3,
                    m->geom_friction + 3 * b);
}

bool IsFoundAlready(const mjModel* m, const mjData* d, int g1, int g2, const mjContact& contact) {
  return std::any_of(d->contact, d->contact + d->ncon, [&](const mjContact& found) {
    return AreOneBody(m, found.geom1, g1) && AreOneBody(m, found.geom2, g2) &&
           mju_dist3(found.pos, contact.pos) < kSamePlace &&
           mju_dot3(found.frame, contact.frame) > kSameNormal;
  });
}

int CheckedBoxBox(const mjModel* m, const mjData* d, mjContact* contacts, int g1, int g2,
                  mjtNum margin) {
  const int count = engine_box_box(m, d, contacts, g1, g2, margin);
  mjContact* const end = std::remove_if(contacts, contacts + count, [&](const mjContact& contact) {
    const Eigen::Map<const Vector3> p(contact.pos);
    return !LiesIn(m, d, g1, p) || !LiesIn(m, d, g2, p) || IsFoundAlready(m, d, g1, g2, contact);
  });
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
