#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/motion/clear/collision_scene.h"
#include "planner/motion/path/joint_path.h"

namespace assay::motion {

// What the arm is to do at safe height: go over `X_WorldTool`, in such a configuration that the
// straight lines that follow, from corner to corner (origins of the tool, world), can be followed.
struct TravelRequest {
  JointVector from;
  Pose X_WorldTool;
  std::vector<Vector3> corners;
  double line_step = 0.0005;  // metres, in which the lines are followed
  // The arm's links, too, stay clear of everything, on the lines and on the way to them.
  bool is_arm_watched = false;
};

// A path, or why there is none; where the arm is looked at, with the pair of bodies in the way.
using TravelResult = std::variant<JointPath, std::string>;

// Plans the path. Of the joint values that bring the tool there (up to eight configurations, joints
// 4 and 6 with up to two turns each) those nearest in time come first; the way is a joint move, or
// two of them by way of the workcell's home. Hand, fingers and held part must stay kTravelGap away
// from the table and from the parts; the arm is looked at only if it is said.
//
// Where the workcell has other robots, the whole arm must stay as far from them, also on the lines.
// Where the arm is looked at and no such way is free, one around everything is searched (FindPath).
TravelResult PlanTravel(const domain::Problem& problem, const Surroundings& surroundings,
                        const TravelRequest& request);

inline constexpr double kTravelGap = 0.01;  // metres

// Joint values that bring the tool to a pose, the nearest in time to `from` first.
std::vector<JointVector> PosturesAt(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                    const JointVector& from);
// The way of the arm from q on along all lines, each from the end of the one before (FollowLine);
// none if it cannot follow.
std::optional<JointPath> FollowLines(const domain::Workcell& workcell, const JointVector& q,
                                     const std::vector<Vector3>& corners, double step);

}  // namespace assay::motion
