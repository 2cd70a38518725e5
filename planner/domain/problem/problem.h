#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/domain/grasp/grasp.h"
#include "planner/domain/mating/mating.h"
#include "planner/domain/mating/mating_errors.h"
#include "planner/domain/part/part_model.h"
#include "planner/domain/problem/pose_error.h"
#include "planner/domain/problem/tolerances.h"
#include "planner/domain/workcell/uncertainty_operations.h"
#include "planner/domain/workcell/workcell.h"

namespace assay::domain {

// A part of a problem: a named copy of a model, and where it is at the start.
struct Part {
  std::string name;
  std::shared_ptr<const PartModel> model;
  std::shared_ptr<const std::vector<Grasp>> grasps;  // by the workcell's gripper; shared by model
  Pose X_WorldPart = Pose::Identity();               // at the start; for an assembled part, derived
  // At the start. resting: None if it leans, lies on another part or is assembled. hidden: the
  // features that the table or other parts cover. position_class: the stable pose that it rests
  // in, else the one that hides the same features.
  StablePoseId resting = StablePoseId::None();
  std::vector<FeatureNumber> hidden = {};
  StablePoseId position_class = StablePoseId::None();
  PoseError error;
  // With which a fixture presses it down while something is mated with it; 0: it has none. Newtons.
  double clamp = 0;
};

// That a part is in one of several poses at the start, and that only a look at it tells which.
struct OpenPose {
  PartId part;
  std::vector<std::string> names;  // of the poses, at least two
  int chosen = 0;                  // which of them the problem has

  bool operator==(const OpenPose&) const = default;
};

// part_location(Part, Position) as a goal: the part ends in one of these stable poses.
struct LocatedGoal {
  PartId part;
  std::vector<StablePoseId> stable_poses;

  bool operator==(const LocatedGoal&) const = default;
};

// What the user wants to hold at the end: a mating of the problem, or a part's resting pose.
using Goal = std::variant<MatingId, LocatedGoal>;

// A scenario as the planner sees it.
struct Problem {
  std::string name;         // the file's, without its ending
  std::string title;        // one line for people; may be empty
  std::string description;  // may be empty
  std::shared_ptr<const Workcell> workcell;
  std::vector<Part> parts;
  std::vector<OpenPose> open_poses = {};  // of these parts, in their order
  std::vector<Mating> matings;
  std::vector<MatingId> assembled;  // true at the start
  std::vector<Goal> goals;
  PoseError gripper_error;
  std::vector<std::string> sensors;  // of the workcell that may be used: "overhead-camera"
  // What may be done about uncertainty, each once, in the order of the enum; by default as in Spar.
  std::vector<ResolverKind> resolvers = {ResolverKind::kSensing, ResolverKind::kSqueezing};
  double clearance = 0;        // metres on each side of a mated shaft
  Tolerances tolerances = {};  // of the clearance, and of the workcell's frictions
  MatingErrors mating_errors = {};

  const Part& part(PartId id) const { return parts[id.index()]; }
  const Mating& mating(MatingId id) const { return matings[id.index()]; }
};

// Which grasps are looked for in a workcell, for the robot that acts.
GraspSearch GraspsIn(const Workcell& workcell);

// The same problem for another robot of its workcell: parts, matings and goals stay, grasps are by
// that robot's gripper.
Problem WorkedBy(const Problem& problem, RobotId robot);

}  // namespace assay::domain
