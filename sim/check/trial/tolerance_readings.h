#pragma once

#include <optional>

#include "planner/plan/data/plan.h"
#include "sim/scene/scene.h"

namespace assay::check {

// What the engine has, in one scene, of the quantities that domain::Tolerances is about: what its
// compiled model says, and what comes of it where bodies touch. None: there is nothing that it
// could be read from.
struct ToleranceReadings {
  // Of the first mating with a hole that widens with the clearance, metres: how far a wall is from
  // the hole's axis, found by a ray; and how far the held part, drawn out of its seat a little, can
  // be moved towards that wall until it touches.
  std::optional<double> wall;
  std::optional<double> play;
  // Sliding friction of the first part, where it rests at the start: of its geom, and of the
  // contact.
  std::optional<double> part_geom;
  std::optional<double> part_contact;
  // Likewise of the pads, closed on the part that the plan first picks up.
  std::optional<double> pad_geom;
  std::optional<double> pad_contact;
};

ToleranceReadings ReadTolerances(const domain::Problem& problem, const plan::Plan& plan,
                                 const scene::Scene& scene);

}  // namespace assay::check
