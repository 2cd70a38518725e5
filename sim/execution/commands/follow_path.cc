#include <cmath>

#include "planner/motion/paths/straight_line.h"
#include "sim/execution/commands/run.h"

namespace assay::execution {
namespace {

// Returns whether two postures are whole turns apart, or in different configurations of the arm. If
// so, the checks of the path do not hold for a way from one to the other.
bool IsOtherPosture(const kinematics::Arm& arm, const JointVector& a, const JointVector& b) {
  return arm.IndicatorsOf(a) != arm.IndicatorsOf(b) || (a - b).cwiseAbs().maxCoeff() > M_PI;
}

}  // namespace

// The arm goes from its present posture to the path's start, along the path, and from the path's
// end to the posture for X_WorldTool. The checks of the path hold for its way. The two short
// motions at the ends are within what errors may do to the tool, which the preconditions kReach and
// kWayClear cover.
Progress Run(const FollowPath& follow, std::span<const Command>, Execution& execution) {
  const domain::Workcell& workcell = *execution.problem().workcell;
  motion::JointPath path = follow.path;
  if (IsOtherPosture(workcell.arm(), execution.commanded(), path.front())) {
    return Failure{TrialOutcome::kUnreachable,
                   "the arm is not in the configuration in which the planned path starts"};
  }
  const auto end = motion::PostureLike(workcell, execution.Erring(follow.X_WorldTool), path.back());
  if (!end) {
    return Failure{TrialOutcome::kUnreachable,
                   "the arm does not reach the end of the planned path in its configuration"};
  }
  path.insert(path.begin(), execution.commanded());
  path.push_back(*end);
  const JointTrajectory way = motion::AlongPath(path, motion::RatesOf(workcell));
  return execution.Follow(way);
}

}  // namespace assay::execution
