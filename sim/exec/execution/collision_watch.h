#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "sim/scene/scene.h"

namespace assay::exec {

using domain::PartId;

// Bodies that touch and should not; the first is a robot's, or the part's in its hand.
struct Collision {
  mujoco::BodyId robot;
  mujoco::BodyId other;

  auto operator<=>(const Collision&) const = default;
};

// What a part in the hand may touch besides hands.
enum class HeldTouches {
  kAnything,  // in steps of plans: parts lie on each other and slide into each other
  kTables,    // where it is taken up and put down; and what it touched when it was taken
  kNothing,
};

// Watches what arms, hands and what they hold touch. Links of an arm may touch nothing; hands and
// fingers the table and the parts that they handle, and no other robot.
class CollisionWatch {
 public:
  explicit CollisionWatch(const scene::Scene& scene);

  // From now on hands may touch these parts and no others; at first, all.
  // And a part in the hand only this; at first, anything.
  void Handle(std::vector<PartId> parts, HeldTouches held = HeldTouches::kAnything);

  // The collisions of the present that were not there at any look before. `held`: what is in the
  // hand; None: nothing.
  std::vector<Collision> Look(const mujoco::Data& data, PartId held = PartId::None());

 private:
  bool IsAllowed(const Collision& touch) const;
  bool IsRobot(mujoco::BodyId body) const;
  bool IsHeld(mujoco::BodyId body) const;
  // A robot's body first, of two robots' the arm's; else that of the held part.
  Collision InOrder(Collision touch) const;

  std::vector<scene::BodyKind> kinds_;  // by BodyId
  std::vector<PartId> parts_;           // by BodyId; None: no part
  std::optional<std::vector<PartId>> handled_;
  HeldTouches held_touches_ = HeldTouches::kAnything;
  PartId held_;
  std::set<mujoco::BodyId> taken_from_;  // what the held part touched when it was taken
  std::set<Collision> seen_;
};

}  // namespace assay::exec
