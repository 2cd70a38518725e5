#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/domain/parts/placed_part.h"
#include "planner/domain/problem/problem.h"

namespace assay::domain {

// The conditions under which a hand can hold a part somewhere. Each can be broken by itself.
enum class GraspCondition : std::uint16_t {
  kOpening = 1,     // the gripper opens wide enough
  kFacesFree = 2,   // the pads' faces are not on the table (Spar, condition 1 of reachable)
  kToolLean = 4,    // the tool points roughly down
  kTableClear = 8,  // hand and fingers stay above the height of the table, also beside it
  kReach = 16,      // the arm goes the action's straight ways, from the safe height and back to
                    // it, within its joint limits, and in one configuration if rules say so
  kMateClear = 32,  // hand and fingers do not go through the fixed part of the mating
  kPadsFit = 64,    // the pads have room on the faces: always true unless misfits are sought
};
inline constexpr std::array kGraspConditions = {
    GraspCondition::kFacesFree, GraspCondition::kTableClear, GraspCondition::kMateClear,
    GraspCondition::kReach,     GraspCondition::kOpening,    GraspCondition::kPadsFit,
    GraspCondition::kToolLean};
using GraspConditions = std::uint16_t;  // a set of conditions
constexpr GraspConditions operator|(GraspCondition a, GraspCondition b) {
  return static_cast<GraspConditions>(static_cast<int>(a) | static_cast<int>(b));
}

// Returns the conditions of reachable(Grasp, Position) that fail for a part held with `grasp` and
// resting in the world at X_WorldPart. Other parts are ignored.
GraspConditions BrokenAt(const Problem& problem, PartId part, GraspId grasp,
                         const Pose& X_WorldPart);

// Returns the conditions that fail for a part in a stable pose, wherever it is placed. kReach
// counts as failed if it fails at every placement of the workcell. Spar assumes that some placement
// is reachable; this function searches for one.
GraspConditions BrokenIn(const Problem& problem, PartId part, GraspId grasp, StablePoseId pose);

// Return the conditions of mate_reachable(Grasp, Position, Ta) that fail with the fixed part at
// this pose, or in this stable pose at any placement.
GraspConditions BrokenMatingAt(const Problem& problem, MatingId mating, GraspId grasp,
                               const Pose& X_WorldFixed);
GraspConditions BrokenMatingIn(const Problem& problem, MatingId mating, GraspId grasp,
                               StablePoseId pose_of_fixed);

// Return true if all conditions hold. This is faster than listing the broken ones, since the first
// broken condition ends the search.
bool IsReachableAt(const Problem& problem, PartId part, GraspId grasp, const Pose& X_WorldPart);
bool IsReachableIn(const Problem& problem, PartId part, GraspId grasp, StablePoseId pose);
bool IsMateReachableAt(const Problem& problem, MatingId mating, GraspId grasp,
                       const Pose& X_WorldFixed);
bool IsMateReachableIn(const Problem& problem, MatingId mating, GraspId grasp,
                       StablePoseId pose_of_fixed);

// These functions split mate_reachable in two: kMateClear, which does not depend on where the fixed
// part stands, and all other conditions.
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

// Returns the quantity that a condition of reachability limits, for a part that is held with
// `grasp` while the tool is at X_WorldTool: the width between the pads, the room that the pads need
// on the faces, the tool's lean, or how deep hand and fingers are in the table. Returns none for
// conditions without a quantity.
std::optional<Limited> Measure(const Problem& problem, GraspCondition condition, const Grasp& grasp,
                               const Pose& X_WorldTool);
// Returns the angle of a direction of approach from straight down, in radians.
double LeanOf(const Vector3& direction);

// Returns the first of `others` that hand or fingers would go through when the tool is at
// X_WorldTool with the given opening. Returns None if they are free.
PartId Obstacle(const Problem& problem, const Pose& X_WorldTool, double opening,
                std::span<const PlacedPart> others);
// Returns the first of `others` that a moving part, held or put down, would go through. `others`
// may contain the part itself.
PartId Obstacle(const Problem& problem, const PlacedPart& moving,
                std::span<const PlacedPart> others);

// Returns the condition of reachability in words that fit the problem: "the tool leans at most 60
// deg from straight down".
std::string Describe(const Problem& problem, GraspCondition condition);

}  // namespace assay::domain
