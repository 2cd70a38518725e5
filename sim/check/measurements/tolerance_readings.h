#pragma once

#include <optional>

#include "planner/plan/data/plan.h"
#include "sim/scene/scene.h"

namespace assay::check {

// The true values, in one scene of the engine, of the quantities that domain::Tolerances is about.
// For each quantity there is the value in the compiled model and the value that results where
// bodies touch. A value is missing if the scene has nothing to read it from.
struct ToleranceReadings {
  // These two values, in metres, are about the first mating with a hole that widens with the
  // clearance. `wall` is the distance of a wall from the hole's axis, found by a ray. `play` is the
  // distance that the held part, drawn out of its seat a little, can be moved towards this wall
  // until it touches.
  std::optional<double> wall;
  std::optional<double> play;
  // Sliding friction of the first part at its place at the start: the friction of its geom, and the
  // friction of its contact.
  std::optional<double> part_geom;
  std::optional<double> part_contact;
  // Sliding friction of the pads, closed on the part that the plan picks up first: the friction of
  // a pad's geom, and the friction of its contact.
  std::optional<double> pad_geom;
  std::optional<double> pad_contact;
};

// Reads the tolerances in `scene`, which must be built from `problem`.
ToleranceReadings ReadTolerances(const domain::Problem& problem, const plan::Plan& plan,
                                 const scene::Scene& scene);

}  // namespace assay::check
