#pragma once

#include <optional>
#include <vector>

#include "planner/domain/workcell/workcell.h"

namespace assay::motion {

using geometry::Pose;
using geometry::Vector3;
using kinematics::JointVector;

// Joint values at equal distances along a straight line of the tool, which keeps its orientation.
struct LinePath {
  double step = 0;             // metres between neighbours
  std::vector<JointVector> q;  // at least two postures, from the start of the line to its end
};

// The result of following a line: its path, or the first point (origin of the tool, world) where
// the arm could not follow in its initial configuration, within its limits and without sudden
// turns.
struct LineResult {
  std::optional<LinePath> path;
  Vector3 stuck_at = Vector3::Zero();
};

inline constexpr double kLineStep = 0.0005;  // metres

// Follows the line from where the tool is with joint values `from` to `end`, in steps of at most
// `step` metres.
LineResult FollowLine(const domain::Workcell& workcell, const JointVector& from, const Vector3& end,
                      double step = kLineStep);

// Returns the joint values nearest to `near` that bring the tool to X_WorldTool. Returns none if
// the arm does not reach this pose.
std::optional<JointVector> NearestPosture(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                          const JointVector& near);

// Returns the joint values that bring the tool to X_WorldTool in the configuration of `like`. Each
// joint is less than half a turn from its value in `like`. Returns none if no such joint values are
// within the limits of the joints.
std::optional<JointVector> PostureLike(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                       const JointVector& like);

// Returns X_WorldTool with these joint values.
Pose ToolAt(const domain::Workcell& workcell, const JointVector& q);

}  // namespace assay::motion
