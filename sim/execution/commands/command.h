#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/plan/data/plan.h"
#include "sim/execution/control/pace.h"

namespace assay::execution {

using domain::PartId;
using geometry::Pose;
using geometry::Vector3;

// The commands that a robot executes: the primitives of Spar's execution module (Hutchinson and Kak
// 1990, Table 4 and figure 18).

// The tool goes to a pose at safe height, above all parts.
struct MoveAtSafeHeight {
  Pose X_WorldTool;
};

// The arm goes along a path of the plan, straight in joint space from posture to posture. It ends
// at X_WorldTool, the tool's pose for the believed poses of the parts, which is millimetres from
// the planned end.
struct FollowPath {
  std::vector<kinematics::JointVector> path;
  Pose X_WorldTool;
};

// The condition that ends a move: resistance.
struct Guard {
  double force = 0;  // newtons against the motion, more than before it
};

// The tool goes along a straight line and keeps its orientation.
struct MoveStraight {
  Pose X_WorldTool;
  Pace pace;
  std::optional<Guard> guard = {};  // the guard, which is active on the whole way
};

// Fingers have come to rest when they were slower than kFingersStill for kFingersStillFor.
inline constexpr double kFingersStill = 1e-4;     // m/s of the opening
inline constexpr double kFingersStillFor = 0.05;  // seconds

// The gripper opens wide. A part that the gripper held is believed to stay where the gripper
// released it.
struct OpenGripper {
  struct Release {
    PartId part;
    Pose X_WorldPart;
  };
  std::optional<Release> release = {};
};

// The gripper closes on a part. From then on the part is believed to be held in this way.
struct CloseGripper {
  PartId part;
  plan::Hold hold;
  bool is_squeeze = false;  // the hand will let the part go where it is
};

// A sensor looks at a part. The believed pose takes over the measured coordinates that the sensor
// knows better (uncertainty::TakesOver).
struct Look {
  PartId part;
  std::string sensor;
  struct Takes {
    bool x = true, y = true, z = true, yaw = true;
  } takes = {};
};

// The fixture of a part presses the part down on the table with this force. If the force is 0, the
// fixture releases the part.
struct Clamp {
  PartId part;
  double force = 0;  // newtons on the part, downward
};

// Hybrid control of position and force leads the held part into the fixed one. It begins where the
// strategy starts.
struct FollowStrategy {
  plan::Strategy strategy;
  PartId fixed;
};

using Command = std::variant<MoveAtSafeHeight, FollowPath, MoveStraight, OpenGripper, CloseGripper,
                             Look, Clamp, FollowStrategy>;

// Returns one line for people, in millimetres and the world frame.
std::string Text(const domain::Problem& problem, const Command& command);

}  // namespace assay::execution
