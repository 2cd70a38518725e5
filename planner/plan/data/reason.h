#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/domain/parts/placed_part.h"
#include "planner/domain/units/units.h"
#include "planner/kinematics/arm.h"

namespace assay::plan {

// A piece of a robot, or a part. Tables and the floor have neither a robot nor a part.
struct NamedBody {
  domain::RobotId robot = domain::RobotId::None();
  std::string piece = {};  // of the robot: the name of a link, "hand" or "fingers"
  domain::PartId part = domain::PartId::None();
};

// A quantity that exceeds its limit.
struct Excess {
  domain::Dimension dimension = domain::Dimension::kLength;
  double value = 0;  // metres or radians
  double limit = 0;  // the greatest allowed value
};

// The hand of a robot at a pose.
struct PlacedHand {
  domain::RobotId robot;
  geometry::Pose X_WorldTool;
  double opening = 0;  // metres between the pads
  // The posture of the arm. None if the posture does not matter, or if the arm does not reach.
  std::optional<kinematics::JointVector> posture = {};
};

// A situation in which a constraint fails, as data for pictures and programs. Everything that it
// does not list is as at the start of the problem.
struct Situation {
  std::vector<domain::PlacedPart> parts = {};  // the parts that the constraint is about
  std::optional<PlacedHand> hand = {};
  std::vector<NamedBody> colliding = {};  // what comes too near to each other
  std::optional<Excess> excess = {};      // none if the constraint limits no quantity
};

// A reason why there is no plan: a sentence for people, and the situation that it is about. The
// situation is missing if the sentence is about none, or if a plan file was read, which holds the
// sentences alone.
struct Reason {
  std::string text;
  std::optional<Situation> situation = {};
};

inline std::vector<std::string> TextsOf(const std::vector<Reason>& reasons) {
  std::vector<std::string> texts;
  for (const Reason& reason : reasons) texts.push_back(reason.text);
  return texts;
}

}  // namespace assay::plan
