#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/motion/joint_trajectory.h"
#include "sim/exec/world_model.h"

namespace assay::exec {

using kinematics::JointVector;
using motion::JointTrajectory;

// What the arm is to do at safe height: go over `X_WorldTool`, in such a configuration that the
// straight lines that follow, from corner to corner (origins of the tool, world), can be followed.
struct TravelRequest {
  JointVector from;
  double opening = 0;  // metres between the pads on the way
  Pose X_WorldTool;
  std::vector<Vector3> corners;
};

// Joint moves, one after the other, or why there are none.
using TravelResult = std::variant<std::vector<JointTrajectory>, std::string>;

// Plans the moves. Of the joint values that bring the tool there (up to eight configurations,
// joints 4 and 6 with up to two turns each) those nearest in time come first; the way is a
// synchronized joint move, or two of them by way of the workcell's home. Hand, fingers and held
// part must stay kTravelGap away from the table and from the parts where they are believed to be.
TravelResult PlanTravel(const domain::Problem& problem, const WorldModel& world,
                        const TravelRequest& request);

inline constexpr double kTravelGap = 0.01;  // metres

}  // namespace assay::exec
