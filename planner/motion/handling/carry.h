#pragma once

#include <optional>

#include "planner/motion/paths/travel.h"

namespace assay::motion {

// A carry of the held part over a table.
struct CarryRequest {
  JointVector from;
  const domain::Table& table;
  // The greatest angle, in radians, between the vertical and the direction of the tool that points
  // up at the start; none: any angle.
  std::optional<double> tilt = {};
  // The pose of the tool by the arm's kinematics, relative to the pose where the tool is believed
  // to be. If the two poses differ, their difference stays the same while the arm moves.
  Pose X_BelievedTool = Pose::Identity();
};

// Plans a path to a posture above a free place of the table (FreePosesOn). From this posture the
// arm can put the part down along straight lines, on which it stays clear of everything (as
// PlanTravel asks). `surroundings` must have a held part. If several places and postures fail, the
// result gives the reason why the first of them failed.
TravelResult PlanCarry(const domain::Problem& problem, const Surroundings& surroundings,
                       const CarryRequest& request);

}  // namespace assay::motion
