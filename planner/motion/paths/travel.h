#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/motion/collision/surroundings.h"
#include "planner/motion/paths/joint_path.h"

namespace assay::motion {

// A travel at safe height to `X_WorldTool`. The arm must arrive in a configuration in which it can
// follow the straight lines after it, from corner to corner (origins of the tool, world).
struct TravelRequest {
  JointVector from;
  Pose X_WorldTool;
  std::vector<Vector3> corners;
  double line_step = 0.0005;  // step in which the lines are followed, metres
  // Set if the arm's links must stay clear of everything, too, on the lines and on the way to them.
  bool is_arm_watched = false;
};

// A path, or the reason why there is none. If the arm is watched, the reason names the pair of
// bodies in the way.
using TravelResult = std::variant<JointPath, std::string>;

// Plans the travel. Several joint values bring the tool to its pose: up to eight configurations,
// with up to two turns of joints 4 and 6 each. The joint values that are reached soonest are tried
// first. The travel is one joint move, or two joint moves by way of the workcell's home. Hand,
// fingers and held part must stay kTravelGap away from the table and from the parts; the arm is
// tested only if the request says so.
//
// If the workcell has other robots, the whole arm must stay kTravelGap away from them, on the
// straight lines too. If the request tests the arm and no simple way is free, a path around
// everything is searched for (FindPath).
TravelResult PlanTravel(const domain::Problem& problem, const Surroundings& surroundings,
                        const TravelRequest& request);

inline constexpr double kTravelGap = 0.01;  // metres

// Plans a path from the posture to the acting robot's home (FindPath). Arm, hand and held part stay
// kTravelGap away from everything.
TravelResult PlanWayHome(const domain::Problem& problem, const Surroundings& surroundings,
                         const JointVector& from);

// Returns joint values that bring the tool to a pose, the nearest in time to `from` first.
std::vector<JointVector> PosturesAt(const domain::Workcell& workcell, const Pose& X_WorldTool,
                                    const JointVector& from);
// Returns the way of the arm from q along all lines, each from the end of the one before
// (FollowLine). Returns none if the arm cannot follow.
std::optional<JointPath> FollowLines(const domain::Workcell& workcell, const JointVector& q,
                                     const std::vector<Vector3>& corners, double step);

}  // namespace assay::motion
