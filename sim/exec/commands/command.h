#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/exec/control/pace.h"

namespace assay::exec {

using domain::PartId;
using geometry::Pose;
using geometry::Vector3;

// What the robot can be told: the primitives of Spar's execution module (Hutchinson and Kak 1990,
// Table 4 and figure 18).

// The tool goes, high above everything, to a pose at safe height.
struct MoveAtSafeHeight {
  Pose X_WorldTool;
};

// The arm goes along a path that the plan holds, straight in joint space from posture to posture,
// to where the tool is now believed to have to be at its end: millimetres from where it was
// planned.
struct FollowPath {
  std::vector<kinematics::JointVector> path;
  Pose X_WorldTool;
};

// A move that ends where it meets resistance.
struct Guard {
  double force = 0;  // newtons against the motion, more than before it
};

// The tool goes along a straight line, its orientation kept.
struct MoveStraight {
  Pose X_WorldTool;
  Pace pace;
  std::optional<Guard> guard = {};  // felt on the whole way
};

// Fingers have come to rest that are no faster than this for so long.
inline constexpr double kFingersStill = 1e-4;     // m/s, of the opening
inline constexpr double kFingersStillFor = 0.05;  // seconds

// The gripper opens wide. If it held a part, the part is believed to stay where it is let go.
struct OpenGripper {
  struct Release {
    PartId part;
    Pose X_WorldPart;
  };
  std::optional<Release> release = {};
};

// The gripper closes on a part, which is believed to be held so from then on.
struct CloseGripper {
  PartId part;
  plan::Hold hold;
};

// A sensor looks at a part, and what is believed of its pose becomes what the sensor tells, in the
// coordinates that it knows better (uncertainty::TakesOver).
struct Look {
  PartId part;
  std::string sensor;
  struct Takes {
    bool x = true, y = true, z = true, yaw = true;
  } takes = {};
};

// A part's fixture presses it down on the table; with no force, it lets go.
struct Clamp {
  PartId part;
  double force = 0;  // newtons
};

// Hybrid control of position and force leads the held part into the fixed one, from where the
// strategy starts.
struct FollowStrategy {
  plan::Strategy strategy;
  PartId fixed;
};

using Command = std::variant<MoveAtSafeHeight, FollowPath, MoveStraight, OpenGripper, CloseGripper,
                             Look, Clamp, FollowStrategy>;

// One line for people; millimetres, world frame.
std::string Text(const domain::Problem& problem, const Command& command);

}  // namespace assay::exec
