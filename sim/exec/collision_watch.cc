#include "sim/exec/collision_watch.h"

#include <mujoco/mujoco.h>

#include <algorithm>

namespace assay::exec {

using mujoco::BodyId;
using scene::BodyKind;

CollisionWatch::CollisionWatch(const scene::Scene& scene) {
  const auto count = static_cast<std::size_t>(scene.model().get()->nbody);
  for (std::size_t i = 0; i < count; ++i) kinds_.push_back(scene.KindOf(BodyId(i)));
  parts_.assign(count, PartId::None());
  for (int p = 0; p < scene.part_count(); ++p) {
    parts_[static_cast<std::size_t>(scene.Body(PartId(p)).index())] = PartId(p);
  }
}

bool CollisionWatch::IsRobot(BodyId body) const {
  const BodyKind kind = kinds_[static_cast<std::size_t>(body.index())];
  return kind == BodyKind::kArm || kind == BodyKind::kHand;
}

bool CollisionWatch::IsAllowed(const Collision& touch) const {
  const auto other = static_cast<std::size_t>(touch.other.index());
  if (kinds_[static_cast<std::size_t>(touch.robot.index())] == BodyKind::kArm) return false;
  if (kinds_[other] == BodyKind::kWorld) return true;
  if (kinds_[other] != BodyKind::kPart) return false;
  return !handled_ || std::ranges::count(*handled_, parts_[other]) > 0;
}

std::vector<Collision> CollisionWatch::Look(const mujoco::Data& data) {
  std::vector<Collision> found;
  const mjModel& m = *data.own_model();
  for (int i = 0; i < data.get()->ncon; ++i) {
    const mjContact& contact = data.get()->contact[i];
    Collision touch{BodyId(m.geom_bodyid[contact.geom1]), BodyId(m.geom_bodyid[contact.geom2])};
    if (!IsRobot(touch.robot)) std::swap(touch.robot, touch.other);
    if (!IsRobot(touch.robot)) continue;
    // Of two robots' bodies the arm is blamed first.
    if (kinds_[static_cast<std::size_t>(touch.other.index())] == BodyKind::kArm) {
      std::swap(touch.robot, touch.other);
    }
    if (!IsAllowed(touch) && seen_.insert(touch).second) found.push_back(touch);
  }
  return found;
}

}  // namespace assay::exec
