#pragma once

#include <optional>
#include <vector>

#include "planner/domain/workcell/workcell.h"

namespace assay::motion {

using geometry::Pose;
using geometry::Vector3;
using kinematics::JointVector;

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

inline constexpr double kLineStep = 0.0005;  // metres

// The line from where the tool is with joint values `from` to `end`, in steps of at most `step`
// metres.
LineResult FollowLine(const domain::Workcell& workcell, const JointVector& from, const Vector3& end,
                      double step = kLineStep);

// Of the joint values that bring the tool there, those that are the nearest to `near`; none if the
// arm does not reach it.
std::optional<JointVector> NearestPosture(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                          const JointVector& near);

// The joint values that bring the tool there in the configuration of `like`, no joint half a turn
// or more from where it is there; none if the arm does not reach it so, within its limits.
std::optional<JointVector> PostureLike(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                       const JointVector& like);

// X_WorldTool with these joint values.
Pose ToolAt(const domain::Workcell& workcell, const JointVector& q);

}  // namespace assay::motion
