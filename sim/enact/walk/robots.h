#pragma once

#include <memory>
#include <vector>

#include "sim/exec/execution/execution.h"

namespace assay::enact {

using domain::RobotId;

// The robots of a workcell on one simulation, an execution each. One acts at a time; the others
// stand at their homes, also with a part in the hand.
class Robots {
 public:
  // All are at their homes, hands empty; the workcell's first robot acts. Keeps references to
  // `data` and `options`.
  Robots(const domain::Problem& problem, const scene::Scene& scene, mujoco::Data& data,
         const exec::ExecutorOptions& options);

  exec::Execution& acting() { return *members_[acting_.index()]->execution; }

  // From now on this robot acts (None: the same as before). The one before goes home first, and
  // tells it where it believes the parts to be.
  exec::Progress TakeOver(RobotId robot);
  // The parts in all hands.
  std::vector<domain::PartId> Held() const;
  // What robots touched and were not to touch until now.
  std::vector<exec::CollisionRecord> Collisions() const;
  // The robot that acts goes home, clear of everything (motion::FindPath).
  exec::Progress GoHome();

 private:
  struct Member {
    domain::Problem problem;
    scene::Scene scene;
    std::unique_ptr<exec::Execution> execution;
  };

  void Tell(const exec::Execution& from, exec::Execution& to) const;
  bool HoldsBesides(RobotId robot) const;

  exec::ExecutorOptions options_;
  const double free_timestep_;
  std::vector<std::unique_ptr<Member>> members_;
  RobotId acting_;
};

}  // namespace assay::enact
