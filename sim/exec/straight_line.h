#pragma once

#include <optional>
#include <vector>

#include "planner/domain/workcell.h"
#include "planner/motion/joint_trajectory.h"
#include "sim/exec/pace.h"

namespace assay::exec {

using geometry::Pose;
using geometry::Vector3;
using kinematics::JointVector;
using motion::JointRates;
using motion::JointTrajectory;

// Joint values along a straight line of the tool, whose orientation is kept, at equal distances.
struct LinePath {
  double step = 0;             // metres between neighbours
  std::vector<JointVector> q;  // at least two, from the start of the line to its end
};

// What became of a line: its path, or the first point (origin of the tool, world) where the arm
// could not follow in the configuration in which it started, within its limits and without leaps.
struct LineResult {
  std::optional<LinePath> path;
  Vector3 stuck_at = Vector3::Zero();
};

// The line from where the tool is with joint values `from` to `end`.
LineResult FollowLine(const domain::Workcell& workcell, const JointVector& from,
                      const Vector3& end);

// X_WorldTool with these joint values.
Pose ToolAt(const domain::Workcell& workcell, const JointVector& q);

struct TimedLine {
  JointTrajectory trajectory;
  double final_from = 0;  // the time at which the pace's final length begins, seconds
};

// The path with times: from rest to rest, as fast as the pace and the joints' rates allow. Speed
// limits are found at each point of the path and acceleration limits between, then one pass
// forward and one backward make them compatible (Bobrow, Dubowsky and Gibson 1985, with limits of
// rates in place of torques). Half of each joint's acceleration is kept for the curvature of its
// path.
TimedLine WithTimes(const LinePath& path, const Pace& pace, const JointRates& rates);

}  // namespace assay::exec
