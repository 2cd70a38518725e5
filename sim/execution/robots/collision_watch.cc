#include "sim/execution/robots/collision_watch.h"

#include <mujoco/mujoco.h>

#include <algorithm>

namespace assay::execution {

using mujoco::BodyId;
using scene::BodyKind;

namespace {

// Returns whether the body can never move.
bool IsFixed(const mjModel& model, BodyId body) { return model.body_weldid[body.index()] == 0; }

}  // namespace

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

bool CollisionWatch::IsHeld(BodyId body) const {
  return !held_.IsNone() && parts_[static_cast<std::size_t>(body.index())] == held_;
}

void CollisionWatch::Handle(std::vector<PartId> parts, HeldTouches held) {
  handled_ = std::move(parts);
  held_touches_ = held;
  taken_from_.clear();
}

bool CollisionWatch::IsAllowed(const Collision& touch) const {
  const auto other = static_cast<std::size_t>(touch.other.index());
  if (IsHeld(touch.robot)) {
    if (held_touches_ == HeldTouches::kAnything || taken_from_.contains(touch.other)) return true;
    return held_touches_ == HeldTouches::kTables && kinds_[other] == BodyKind::kWorld;
  }
  if (kinds_[static_cast<std::size_t>(touch.robot.index())] == BodyKind::kArm) return false;
  if (kinds_[other] == BodyKind::kWorld) return true;
  if (kinds_[other] != BodyKind::kPart) return false;
  return !handled_ || std::ranges::count(*handled_, parts_[other]) > 0;
}

Collision CollisionWatch::InOrder(Collision touch) const {
  if (!IsRobot(touch.robot)) std::swap(touch.robot, touch.other);
  const bool is_arm = kinds_[static_cast<std::size_t>(touch.other.index())] == BodyKind::kArm;
  const bool is_held = !IsRobot(touch.robot) && IsHeld(touch.other);
  if (is_arm || is_held) std::swap(touch.robot, touch.other);
  return touch;
}

std::vector<Collision> CollisionWatch::Look(const mujoco::Data& data, PartId held) {
  const bool is_taken = held != held_;
  held_ = held;
  if (is_taken) taken_from_.clear();
  std::vector<Collision> found;
  const mjModel& m = *data.own_model();
  for (int i = 0; i < data.get()->ncon; ++i) {
    const mjContact& contact = data.get()->contact[i];
    const Collision touch =
        InOrder({BodyId(m.geom_bodyid[contact.geom1]), BodyId(m.geom_bodyid[contact.geom2])});
    if (!IsRobot(touch.robot) && !IsHeld(touch.robot)) continue;
    // An arm's base may be mounted on a table.
    if (IsFixed(m, touch.robot) && IsFixed(m, touch.other)) continue;
    if (is_taken && IsHeld(touch.robot)) taken_from_.insert(touch.other);
    if (!IsAllowed(touch) && seen_.insert(touch).second) found.push_back(touch);
  }
  return found;
}

}  // namespace assay::execution
