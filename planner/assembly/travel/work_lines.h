#pragma once

#include <optional>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/motion/collision/motion_check.h"
#include "planner/motion/paths/path_search.h"
#include "planner/plan/data/tool_route.h"

namespace assay::assembly {

// Metres between the postures that are checked on straight lines.
inline constexpr double kWorkLineStep = 0.02;

// The straight lines of an action's work, from the posture in which the tool is poised on. The tool
// keeps its orientation in each section.
using WorkLines = std::vector<motion::JointPath>;

// Returns whether the action ends in a guarded move, unless a strategy executes it.
bool IsGuarded(const plan::Action& action);

// Follows the lines of a route from a posture at route.poised. A guarded move is followed to the
// farthest pose to which it may lead the tool beyond its work. Where a strategy has turned the
// tool, a new section begins at the nearest posture; the motion in between is checked elsewhere.
// Returns none if the arm cannot follow.
std::optional<WorkLines> FollowWork(const domain::Workcell& workcell, const plan::ToolRoute& route,
                                    bool is_guarded, const kinematics::JointVector& poised);

// Returns the first obstruction of a path, or none if all of it is free.
std::optional<motion::Obstruction> FindObstruction(motion::MotionCheck& check,
                                                   const motion::JointPath& path);

// Appends a straight line to a pose of the tool from the last posture of the path. Returns false if
// the arm cannot follow it.
bool AppendLine(const domain::Workcell& workcell, const geometry::Pose& X_WorldTool,
                motion::JointPath& path);

}  // namespace assay::assembly
