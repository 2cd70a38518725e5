#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/geometry/coordinates.h"
#include "planner/plan/data/plan.h"
#include "sim/view/executed.h"

namespace assay::view {

using Segment = std::pair<geometry::Vector3, geometry::Vector3>;

// When and where an execution shows what decides a condition.
struct DecidingPlace {
  double time = 0;                  // simulated seconds
  std::vector<std::string> bodies;  // names of the moved bodies that the condition is about
  // Segments in the world frame, metres: the outline of a hole that a shaft enters, the shortest
  // line between two bodies that must stay apart, or the line from one pad to the other. Empty for
  // conditions that are not about holes, distances or fingers.
  std::vector<Segment> lines = {};

  bool operator==(const DecidingPlace&) const = default;
};

// Returns the place at which the condition of a claim about a step is decided:
// - whether a shaft fits into its hole: where its tip is in the mouth, or, for what must hold down
//   to the seat, halfway between the mouth and the seat;
// - whether bodies stay apart: where they come nearest to each other;
// - for all other conditions: where the step acts.
// Returns none if the execution did not come to the step.
std::optional<DecidingPlace> PlaceOf(const plan::CertifiedPrecondition& claim, plan::StepId step,
                                     const Executed& executed);

}  // namespace assay::view
