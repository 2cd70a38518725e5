#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/domain/actions/actions.h"
#include "planner/domain/grasps/grasp.h"
#include "planner/domain/matings/mating.h"
#include "planner/domain/matings/mating_errors.h"
#include "planner/domain/parts/part_model.h"
#include "planner/domain/problem/pose_error.h"
#include "planner/domain/problem/tolerances.h"
#include "planner/domain/workcell/uncertainty_operations.h"
#include "planner/domain/workcell/workcell.h"

namespace assay::domain {

// A part of a problem: a named copy of a model, and its place at the start.
struct Part {
  std::string name;
  std::shared_ptr<const PartModel> model;
  // Grasps by the workcell's gripper; shared by model.
  std::shared_ptr<const std::vector<Grasp>> grasps;
  Pose X_WorldPart = Pose::Identity();  // pose at the start; derived if assembled
  // The state at the start. `resting` is None if the part leans, lies on another part or is
  // assembled. `hidden` has the features that the table or other parts cover. `position_class` is
  // the stable pose in which the part rests. If the part rests in no stable pose, it is the stable
  // pose in which the table hides the same features.
  StablePoseId resting = StablePoseId::None();
  std::vector<FeatureNumber> hidden = {};
  StablePoseId position_class = StablePoseId::None();
  PoseError error;  // `z` is that of the fixed part if the part is assembled at the start
  // Force, in newtons, with which a fixture presses the part down while something is mated with it.
  // 0 means that there is no fixture.
  double clamp = 0;
};

// A part that is in one of several poses at the start. Only a look at the part shows in which one.
struct OpenPose {
  PartId part;
  std::vector<std::string> names;  // names of the poses, at least two
  int chosen = 0;                  // index of the pose that the problem has

  bool operator==(const OpenPose&) const = default;
};

// The goal part_location(Part, Position): the part ends in one of these stable poses.
struct LocatedGoal {
  PartId part;
  std::vector<StablePoseId> stable_poses;

  bool operator==(const LocatedGoal&) const = default;
};

// A condition that the user wants to hold at the end: a mating of the problem, or a part's resting
// pose.
using Goal = std::variant<MatingId, LocatedGoal>;

// A scenario from the planner's view.
struct Problem {
  std::string name;         // file name without its ending
  std::string title;        // one line for people; may be empty
  std::string description;  // may be empty
  std::shared_ptr<const Workcell> workcell;
  std::vector<Part> parts;
  std::vector<OpenPose> open_poses = {};  // the open poses of `parts`, in their order
  std::vector<Mating> matings;
  std::vector<MatingId> assembled;  // matings that hold at the start
  std::vector<Goal> goals;
  ActionKinds actions = StandardActions();  // the kinds of action that the robot can do
  PoseError gripper_error;
  std::vector<std::string> sensors;  // sensors of the workcell that may be used: "overhead-camera"
  // The ways to deal with uncertainty that may be used, each once, in the order of the enum. The
  // default is as in Spar.
  std::vector<ResolverKind> resolvers = {ResolverKind::kSensing, ResolverKind::kSqueezing};
  double clearance = 0;        // metres on each side of a mated shaft
  Tolerances tolerances = {};  // tolerances of the clearance and of frictions
  MatingErrors mating_errors = {};
  // A hash of the files that the problem was read from, and of the overrides. Problems that are
  // changed after reading keep it. Empty: the problem was not read from files.
  std::string origin = {};

  const Part& part(PartId id) const { return parts[id.index()]; }
  const Mating& mating(MatingId id) const { return matings[id.index()]; }
};

// Returns which grasps are searched for in a workcell, for the robot that acts.
GraspSearch GraspsIn(const Workcell& workcell);

// Returns the same problem for another robot of its workcell. Parts, matings and goals stay; grasps
// are computed for that robot's gripper.
Problem WorkedBy(const Problem& problem, RobotId robot);

}  // namespace assay::domain
