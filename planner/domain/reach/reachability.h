#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/domain/part/placed_part.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {

// The conditions under which a hand can hold a part somewhere; each can be broken by itself.
enum class GraspCondition : std::uint16_t {
  kOpening = 1,     // the gripper opens wide enough
  kFacesFree = 2,   // the pads' faces are not on the table (Spar, condition 1 of reachable)
  kToolLean = 4,    // the tool points roughly down
  kTableClear = 8,  // hand and fingers do not go through the table
  kReach = 16,      // the arm goes the action's straight ways, from the safe height and back to
                    // it, within its joint limits and in one configuration
  kMateClear = 32,  // hand and fingers do not go through the part that is mated with
  kPadsFit = 64,    // the pads lie wholly on the faces: of grasps without misfits always true
};
inline constexpr std::array kGraspConditions = {
    GraspCondition::kFacesFree, GraspCondition::kTableClear, GraspCondition::kMateClear,
    GraspCondition::kReach,     GraspCondition::kOpening,    GraspCondition::kPadsFit,
    GraspCondition::kToolLean};
using GraspConditions = std::uint16_t;  // a set of them
constexpr GraspConditions operator|(GraspCondition a, GraspCondition b) {
  return static_cast<GraspConditions>(static_cast<int>(a) | static_cast<int>(b));
}

// The conditions of reachable(Grasp, Position) that fail for a part held with `grasp` and resting
// in the world at X_WorldPart, other parts left aside.
GraspConditions BrokenAt(const Problem& problem, PartId part, GraspId grasp,
                         const Pose& X_WorldPart);

// The same where only the stable pose is given: kReach fails if it fails at every placement of
// the workcell (Spar assumes that some placement is reachable; here it is looked for).
GraspConditions BrokenIn(const Problem& problem, PartId part, GraspId grasp, StablePoseId pose);

// The conditions of mate_reachable(Grasp, Position, Ta) that fail with the fixed part there.
GraspConditions BrokenMatingAt(const Problem& problem, MatingId mating, GraspId grasp,
                               const Pose& X_WorldFixed);
GraspConditions BrokenMatingIn(const Problem& problem, MatingId mating, GraspId grasp,
                               StablePoseId pose_of_fixed);

// Whether none fails, which is answered faster: the first that fails is enough.
bool IsReachableAt(const Problem& problem, PartId part, GraspId grasp, const Pose& X_WorldPart);
bool IsReachableIn(const Problem& problem, PartId part, GraspId grasp, StablePoseId pose);
bool IsMateReachableAt(const Problem& problem, MatingId mating, GraspId grasp,
                       const Pose& X_WorldFixed);
bool IsMateReachableIn(const Problem& problem, MatingId mating, GraspId grasp,
                       StablePoseId pose_of_fixed);

// The same in two parts: kMateClear, which is the same wherever the fixed part stands, and all the
// others.
bool HandClearsFixed(const Problem& problem, MatingId mating, GraspId grasp);
bool IsMatingPlaceReachableAt(const Problem& problem, MatingId mating, GraspId grasp,
                              const Pose& X_WorldFixed);
bool IsMatingPlaceReachableIn(const Problem& problem, MatingId mating, GraspId grasp,
                              StablePoseId pose_of_fixed);

// A quantity that a condition limits, in metres or radians.
struct Limited {
  double value = 0;
  double limit = 0;  // the greatest value with which the condition holds

  double excess() const { return value - limit; }
};

// Of the part that is held with `grasp` while the tool is at X_WorldTool: the width between the
// pads, what the pads need of the faces, the tool's lean, or how deep hand and fingers are in the
// table. None for conditions that are no matter of more or less.
std::optional<Limited> Measure(const Problem& problem, GraspCondition condition, const Grasp& grasp,
                               const Pose& X_WorldTool);
// How far the mating vector is from straight down, and the friction cone's half angle.
Limited MatingLean(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed);

// Whether the arm can bring the tool to X_WorldTool by a straight line of `approach` (world frame,
// ending there) within joint limits and without changing its configuration on the way.
bool CanApproach(const Workcell& workcell, const Pose& X_WorldTool, const Vector3& approach);

// The first of `others` that hand or fingers would go through when the tool is at X_WorldTool with
// the given opening; None if it is free.
PartId Obstacle(const Problem& problem, const Pose& X_WorldTool, double opening,
                std::span<const PlacedPart> others);
// The same of a part, held or put down; `others` may contain it.
PartId Obstacle(const Problem& problem, const PlacedPart& moving,
                std::span<const PlacedPart> others);

// Of mating surfaces, whatever it is within its tolerance: the friction cone can be relied on that
// far. 0: straight down only.
double LeastMatingFriction(const Problem& problem);

// The stable poses of the fixed part that hide none of its mating features, with the mating vector
// inside the friction cone: PositionList of assemble (Spar, "A Task Planning Example").
bool HidesMatingFeatures(const Problem& problem, const Mating& mating, StablePoseId pose_of_fixed);
bool InFrictionCone(const Problem& problem, const Mating& mating, const Pose& X_WorldFixed);
// Whether a grasp leaves the held part's mating features free: GraspList of assemble.
bool LeavesMatingFeaturesFree(const Problem& problem, const Mating& mating, GraspId grasp);

// The condition in words that fit the problem: "the tool leans at most 60 deg from straight down".
std::string Describe(const Problem& problem, GraspCondition condition);

}  // namespace assay::domain
