#include "sim/mujoco/collision/found_contact.h"

#include <mujoco/mujoco.h>

#include <algorithm>

namespace assay::mujoco {
namespace {

constexpr double kSamePlace = 1e-6;  // m
constexpr double kSameNormal = 1 - 1e-9;

// Returns whether both geoms move as one body and their contacts have the same parameters.
bool AreOneBody(const mjModel& m, int a, int b) {
  return m.geom_bodyid[a] == m.geom_bodyid[b] && m.geom_condim[a] == m.geom_condim[b] &&
         std::equal(m.geom_friction + 3 * a, m.geom_friction + 3 * a + 3, m.geom_friction + 3 * b);
}

}  // namespace

// The engine sorts the geoms of a contact by their types, so the bodies may be in either order.
bool IsFoundAlready(const mjModel& m, const mjData& d, int geom1, int geom2,
                    const mjContact& contact) {
  return std::any_of(d.contact, d.contact + d.ncon, [&](const mjContact& found) {
    const bool is_same = AreOneBody(m, found.geom1, geom1) && AreOneBody(m, found.geom2, geom2);
    const bool is_turned = AreOneBody(m, found.geom1, geom2) && AreOneBody(m, found.geom2, geom1);
    if (!is_same && !is_turned) return false;
    const double along = mju_dot3(found.frame, contact.frame);
    return mju_dist3(found.pos, contact.pos) < kSamePlace &&
           (is_same ? along : -along) > kSameNormal;
  });
}

}  // namespace assay::mujoco
