#pragma once

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "sim/scene/scene.h"

namespace assay::exec {

using domain::PartId;

// Bodies that touch and should not; the first is a robot's.
struct Collision {
  mujoco::BodyId robot;
  mujoco::BodyId other;

  auto operator<=>(const Collision&) const = default;
};

// Watches what arms and hands touch. Links of an arm may touch nothing; hands and fingers the table
// and the parts that they handle, and no other robot.
class CollisionWatch {
 public:
  explicit CollisionWatch(const scene::Scene& scene);

  // From now on hands may touch these parts and no others; at first, all.
  void Handle(std::vector<PartId> parts) { handled_ = std::move(parts); }

  // The collisions of the present that were not there at any look before.
  std::vector<Collision> Look(const mujoco::Data& data);

 private:
  bool IsAllowed(const Collision& touch) const;
  bool IsRobot(mujoco::BodyId body) const;

  std::vector<scene::BodyKind> kinds_;  // by BodyId
  std::vector<PartId> parts_;           // by BodyId; None: no part
  std::optional<std::vector<PartId>> handled_;
  std::set<Collision> seen_;
};

}  // namespace assay::exec
