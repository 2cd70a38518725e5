#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "sim/scene/scene.h"

namespace assay::execution {

using domain::PartId;

// Two bodies that touch and should not. The first belongs to a robot, or is the part in its hand.
struct Collision {
  mujoco::BodyId robot;
  mujoco::BodyId other;

  auto operator<=>(const Collision&) const = default;
};

// The bodies that a part in the hand may touch besides hands.
enum class HeldTouches {
  kAnything,  // parts may lie on each other and slide into each other, as in steps of plans
  // the tables on which the part is picked up and put down, and the bodies that it touched when it
  // was picked up
  kTables,
  kNothing,
};

// Watches the contacts of arms, hands and the parts that they hold. Links of an arm may touch
// nothing, except that its base may stand on what cannot move either. Hands and fingers may touch
// the table and the parts that they handle, but no other robot.
class CollisionWatch {
 public:
  explicit CollisionWatch(const scene::Scene& scene);

  // Sets the parts that hands may touch from here on, and the bodies that a part in the hand may
  // touch. Before the first call, hands may touch all parts, and a part in the hand may touch
  // anything.
  void Handle(std::vector<PartId> parts, HeldTouches held = HeldTouches::kAnything);

  // Returns the present collisions that no earlier call has returned. `held` is the part in the
  // hand, or None.
  std::vector<Collision> Look(const mujoco::Data& data, PartId held = PartId::None());

 private:
  bool IsAllowed(const Collision& touch) const;
  bool IsRobot(mujoco::BodyId body) const;
  bool IsHeld(mujoco::BodyId body) const;
  // Returns the pair with the robot's body first. If both bodies belong to robots, the arm's body
  // is first; if neither does, the held part is first.
  Collision InOrder(Collision touch) const;

  std::vector<scene::BodyKind> kinds_;  // by BodyId
  std::vector<PartId> parts_;           // by BodyId; None if the body is no part
  std::optional<std::vector<PartId>> handled_;
  HeldTouches held_touches_ = HeldTouches::kAnything;
  PartId held_;
  std::set<mujoco::BodyId> taken_from_;  // bodies that the held part touched when it was picked up
  std::set<Collision> seen_;
};

}  // namespace assay::execution
