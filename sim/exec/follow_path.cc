#include "planner/motion/straight_line.h"
#include "sim/exec/execution.h"

namespace assay::exec {
namespace {

// Radians by which an end of a path may differ from where it was planned: errors that are sensed
// make for hundredths. More is another configuration of the arm.
constexpr double kGreatestCorrection = 0.2;

bool IsNear(const JointVector& a, const JointVector& b) {
  return (a - b).cwiseAbs().maxCoeff() < kGreatestCorrection;
}

}  // namespace

// The path's ends are moved, and with them its first and its last motion: none of their postures by
// more than its end, which the clearance of the path has room for.
Progress Run(const FollowPath& follow, std::span<const Command>, Execution& execution) {
  const domain::Workcell& workcell = *execution.problem().workcell;
  motion::JointPath path = follow.path;
  const Pose X_WorldTool = execution.Erring(follow.X_WorldTool);
  const auto end = motion::NearestPosture(workcell, X_WorldTool, path.back());
  if (!end || !IsNear(*end, path.back())) {
    return Failure{ExecutionOutcome::kUnreachable,
                   "the planned path ends elsewhere than it now would have to"};
  }
  if (!IsNear(execution.commanded(), path.front())) {
    return Failure{ExecutionOutcome::kUnreachable,
                   "the arm is not in the posture in which the planned path starts"};
  }
  path.front() = execution.commanded();
  path.back() = *end;
  const JointTrajectory way = motion::AlongPath(path, motion::RatesOf(workcell));
  return execution.Follow(way, way.duration());
}

}  // namespace assay::exec
