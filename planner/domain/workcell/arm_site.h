#pragma once

#include <optional>

#include "planner/geometry/coordinates.h"
#include "planner/kinematics/arm.h"
#include "planner/kinematics/grippers/gripper.h"

namespace assay::domain {

// A place for an arm in a new workcell. The table is in front of the arm, in the direction of the
// world's x axis, with its top at z = 0. All lengths are in metres.
struct ArmSite {
  geometry::Pose X_WorldBase = geometry::Pose::Identity();
  kinematics::JointVector home = kinematics::JointVector::Zero();
  double safe_height = 0;  // of the tool, for travel
  // The middle of the square on which the arm works, and half of its side. Wherever the tool is
  // over the square, it can point straight down and go straight from the safe height to the table.
  geometry::Vector2 middle = geometry::Vector2::Zero();
  double half_side = 0;
  double table_edge = 0;  // the x of the table's edge beside the base
};

// Finds a place for an arm with a gripper. The arm stands at the height of the table's top, or
// lower if its square becomes larger when it stands lower. The square is as large as the arm
// reaches in one configuration, with its joints away from their limits. At home, the tool points
// straight down over the middle of the square, at the safe height, and no joint is low above the
// table. Returns none if there is no square of 20 cm.
std::optional<ArmSite> FindArmSite(const kinematics::Arm& arm, const kinematics::Gripper& gripper);

}  // namespace assay::domain
