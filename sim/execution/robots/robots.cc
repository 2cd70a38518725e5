#include "sim/execution/robots/robots.h"

#include <algorithm>

#include "planner/motion/paths/joint_trajectory.h"
#include "planner/motion/paths/travel.h"

namespace assay::execution {
namespace {

double TimeOf(const TraceEvent& event) {
  return std::visit(
      [](const auto& record) {
        if constexpr (requires { record.snapshot; }) return record.snapshot.time;
        if constexpr (requires { record.time; }) return record.time;
        return 0.0;  // records of the end of an execution, which no robot makes
      },
      event);
}

}  // namespace

Robots::Robots(const domain::Problem& problem, const scene::Scene& scene, mujoco::Data& data,
               const ExecutorOptions& options)
    : options_(options), acting_(problem.workcell->acting()) {
  for (std::size_t i = 0; i < problem.workcell->robots().size(); ++i) {
    const RobotId robot(i);
    auto member = std::make_unique<Member>(
        Member{domain::WorkedBy(problem, robot), scene.WorkedBy(robot), nullptr});
    member->execution = std::make_unique<Execution>(member->problem, member->scene, data, options_);
    members_.push_back(std::move(member));
  }
}

// A part in the hand of `from` is passed on at the pose in which that hand holds it.
void Robots::Tell(const Execution& from, Execution& to) const {
  for (int i = 0; i < from.world().part_count(); ++i) {
    const domain::PartId part(i);
    if (part == to.world().held()) continue;
    to.world().Believe(part, from.world().PartPose(part, from.BelievedTool()));
  }
}

Progress Robots::TakeOver(RobotId robot) {
  if (robot.IsNone() || robot == acting_) return std::nullopt;
  if (Progress failure = GoHome()) return failure;
  Tell(acting(), *members_[robot.index()]->execution);
  acting_ = robot;
  return std::nullopt;
}

Progress Robots::GoHome() {
  Execution& execution = acting();
  const motion::TravelResult found = motion::PlanWayHome(
      execution.problem(), execution.BelievedSurroundings(), execution.commanded());
  if (const auto* why = std::get_if<std::string>(&found)) {
    return Failure{TrialOutcome::kUnreachable, *why};
  }
  const motion::JointTrajectory way = motion::AlongPath(
      std::get<motion::JointPath>(found), motion::RatesOf(*execution.problem().workcell));
  return execution.Follow(way);
}

std::vector<domain::PartId> Robots::Held() const {
  std::vector<domain::PartId> parts;
  for (const auto& member : members_) {
    const domain::PartId part = member->execution->world().held();
    if (!part.IsNone()) parts.push_back(part);
  }
  return parts;
}

std::vector<CollisionRecord> Robots::Collisions() const {
  std::vector<CollisionRecord> collisions;
  for (const auto& member : members_) {
    for (const auto* collision : member->execution->trace().All<CollisionRecord>()) {
      collisions.push_back(*collision);
    }
  }
  std::ranges::stable_sort(collisions, {}, &CollisionRecord::time);
  return collisions;
}

Trace Robots::WholeTrace() const {
  Trace whole = members_.front()->execution->trace();
  for (std::size_t i = 1; i < members_.size(); ++i) {
    const Trace& trace = members_[i]->execution->trace();
    whole.events.insert(whole.events.end(), trace.events.begin(), trace.events.end());
  }
  std::ranges::stable_sort(whole.events, {}, TimeOf);
  return whole;
}

}  // namespace assay::execution
