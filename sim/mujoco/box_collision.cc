#include "sim/mujoco/box_collision.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <mutex>

#include "planner/geometry/pose.h"

namespace assay::mujoco {
namespace {

using geometry::Vector3;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kOutside = 1e-4;  // m

mjfCollision engine_box_box = nullptr;

bool LiesIn(const mjModel* m, const mjData* d, int geom, const Vector3& p) {
  const Eigen::Map<const Vector3> center(d->geom_xpos + 3 * geom);
  const Eigen::Map<const RowMajor> R_WorldGeom(d->geom_xmat + 9 * geom);
  const Eigen::Map<const Vector3> half_extents(m->geom_size + 3 * geom);
  const Vector3 local = R_WorldGeom.transpose() * (p - center);
  return ((local.cwiseAbs() - half_extents).array() <= kOutside).all();
}

int CheckedBoxBox(const mjModel* m, const mjData* d, mjContact* contacts, int g1, int g2,
                  mjtNum margin) {
  const int count = engine_box_box(m, d, contacts, g1, g2, margin);
  mjContact* const end = std::remove_if(contacts, contacts + count, [&](const mjContact& contact) {
    const Eigen::Map<const Vector3> p(contact.pos);
    return !LiesIn(m, d, g1, p) || !LiesIn(m, d, g2, p);
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
