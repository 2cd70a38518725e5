#pragma once

#include <string>
#include <vector>

#include "planner/domain/actions/actions.h"
#include "planner/domain/matings/mating.h"
#include "planner/geometry/coordinates.h"

namespace assay::plan {

using domain::MatingId;
using domain::PartId;
using geometry::Pose;

// The way in which the hand holds a part. It is complete in itself: an executor of the plan need
// not compute grasps.
struct Hold {
  std::string grasp;  // label for people
  Pose X_PartTool;
  double width = 0;  // metres between the pads

  bool operator==(const Hold& other) const {  // exact comparison
    return grasp == other.grasp && X_PartTool.matrix() == other.X_PartTool.matrix() &&
           width == other.width;
  }
};

// The place where a part rests.
struct Place {
  std::string position;  // label of its stable pose, or "initial"
  Pose X_WorldPart;

  bool operator==(const Place& other) const {  // exact comparison
    return position == other.position && X_WorldPart.matrix() == other.X_WorldPart.matrix();
  }
};

// An action of a plan: its kind, and a value for each argument of the kind. A field for an argument
// that the kind does not have has no meaning. `place` has a meaning for every kind.
struct Action {
  const domain::ActionKind* kind = nullptr;
  PartId part = PartId::None();
  MatingId mating = MatingId::None();
  Hold hold = {};  // of the part that it handles
  Place place = {};
  std::string sensor = {};

  bool Is(const domain::ActionKind& other) const { return kind == &other; }
  bool operator==(const Action&) const = default;
};

// Returns the part that an action handles; in a mating, the held part.
PartId HandledPart(const domain::Problem& problem, const Action& action);
// Returns the part with which an action mates the handled part. Returns None if nothing is mated.
PartId FixedPart(const domain::Problem& problem, const Action& action);
// Returns the part whose place the action states: the fixed part of a mating, or the handled part.
PartId PlacedPart(const domain::Problem& problem, const Action& action);
// Returns the handled part and, in a mating, the fixed part.
std::vector<PartId> PartsOf(const domain::Problem& problem, const Action& action);

// Returns how the hand holds the part that the action handles, or null if the hand does nothing.
const Hold* HoldIn(const Action& action);
// Returns how the hand holds the part that the action handles. It must hold one (checked).
const Hold& HoldOf(const Action& action);
// Returns the pose of the handled part when the pads close or open.
Pose HandledAt(const domain::Problem& problem, const Action& action);

// Returns a text with the arguments that identify the action in its plan: "putdown(block, BP5)".
std::string ShortText(const domain::Problem& problem, const Action& action);
// Returns a text with all arguments: "putdown(block, BG3, BP5)".
std::string FullText(const domain::Problem& problem, const Action& action);

}  // namespace assay::plan
