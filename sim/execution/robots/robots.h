#pragma once

#include <memory>
#include <vector>

#include "sim/execution/robots/execution.h"

namespace assay::execution {

using domain::RobotId;

// The robots of a workcell in one simulation, with one execution for each robot. One robot acts at
// a time. The other robots stand at their homes and may hold a part there.
class Robots {
 public:
  // Starts with all robots at their homes with empty hands. The workcell's acting robot acts first.
  // Keeps a reference to `data` and copies `options`.
  Robots(const domain::Problem& problem, const scene::Scene& scene, mujoco::Data& data,
         const ExecutorOptions& options);

  Execution& acting() { return *members_[acting_.index()]->execution; }

  // Makes `robot` the acting robot; None changes nothing. The robot that acted before goes home
  // first and passes on where it believes the parts to be.
  Progress TakeOver(RobotId robot);
  // Returns the parts in the hands of all robots.
  std::vector<domain::PartId> Held() const;
  // Returns the forbidden contacts of all robots until now, in the order of time.
  std::vector<CollisionRecord> Collisions() const;
  // Returns all records of all robots until now, in the order of time.
  Trace WholeTrace() const;
  // Moves the acting robot home on a path that is clear of everything (motion::PlanWayHome).
  Progress GoHome();

 private:
  struct Member {
    domain::Problem problem;
    scene::Scene scene;
    std::unique_ptr<Execution> execution;
  };

  void Tell(const Execution& from, Execution& to) const;

  ExecutorOptions options_;
  std::vector<std::unique_ptr<Member>> members_;
  RobotId acting_;
};

}  // namespace assay::execution
