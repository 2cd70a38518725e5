#include <cmath>

#include "planner/motion/path/straight_line.h"
#include "sim/exec/execution/execution.h"

namespace assay::exec {
namespace {

// Whole turns apart, or in another of the arm's configurations: then what was found of the path
// says nothing of the way that would be gone.
bool IsOtherPosture(const kinematics::Arm& arm, const JointVector& a, const JointVector& b) {
  return arm.IndicatorsOf(a) != arm.IndicatorsOf(b) || (a - b).cwiseAbs().maxCoeff() > M_PI;
}

}  // namespace

// The arm goes from where errors have it to where the path starts, along the path, and from its end
// to where they now want it: what was found of the path holds for the way that is gone, and the two
// short motions are of the tool as errors may have it anyway ("reach", "way clear").
Progress Run(const FollowPath& follow, std::span<const Command>, Execution& execution) {
  const domain::Workcell& workcell = *execution.problem().workcell;
  motion::JointPath path = follow.path;
  if (IsOtherPosture(workcell.arm(), execution.commanded(), path.front())) {
    return Failure{ExecutionOutcome::kUnreachable,
                   "the arm is not in the configuration in which the planned path starts"};
  }
  const auto end = motion::PostureLike(workcell, execution.Erring(follow.X_WorldTool), path.back());
  if (!end) {
    return Failure{ExecutionOutcome::kUnreachable,
                   "the arm does not reach the end of the planned path in its configuration"};
  }
  path.insert(path.begin(), execution.commanded());
  path.push_back(*end);
  const JointTrajectory way = motion::AlongPath(path, motion::RatesOf(workcell));
  return execution.Follow(way, way.duration());
}

}  // namespace assay::exec
