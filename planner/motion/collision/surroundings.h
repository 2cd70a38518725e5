#pragma once

#include <optional>
#include <vector>

#include "planner/domain/parts/placed_part.h"
#include "planner/domain/workcell/robot.h"
#include "planner/geometry/coordinates.h"
#include "planner/kinematics/arm.h"

namespace assay::motion {

using domain::PartId;
using geometry::Pose;
using geometry::Vector3;
using kinematics::JointVector;

struct HeldPart {
  PartId part;
  Pose X_PartTool;
};

// Another robot of the workcell, which stands still.
struct StandingRobot {
  domain::RobotId robot;
  JointVector q = JointVector::Zero();
  double opening = 0;  // distance between its pads, metres
};

// How far a part may be from its place. It may be turned about the vertical through its origin, and
// then no point of it is farther than `shift` from its place.
struct PlaceError {
  double shift = 0;        // metres, >= 0
  double turn = 0;         // radians, >= 0; a held part has no turn
  bool is_bounded = true;  // false: the part may also be farther away, and nothing is proved
};

// Everything around the arm while it moves.
struct Surroundings {
  std::vector<domain::PlacedPart> parts = {};  // parts that stand still; others are absent
  std::optional<HeldPart> held = {};
  std::vector<PlaceError> errors = {};  // by PartId; empty: no errors
  double opening = 0;                   // distance between the pads, metres
  // Robots that are not listed stand at their homes with open grippers.
  std::vector<StandingRobot> robots = {};
};

}  // namespace assay::motion
