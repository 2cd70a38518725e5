#pragma once

#include <string>
#include <vector>

#include "planner/plan/plan.h"
#include "sim/check/claim.h"
#include "sim/scene/mjcf.h"

namespace assay::check {

// What the engine cannot tell from nothing, measured on the very parts of a plan without noise.
// Observed errors that are smaller say nothing about a prediction.

// Of one component of an error set; metres or radians.
struct ComponentGate {
  Claimed about = Claimed::kAfter;
  std::string name;  // as in Claim
  // True minus believed without any noise: sag, slip, settling; and what of the displacements along
  // the other axes noise may turn into this one.
  double offset = 0;
  double step_size = 0;  // how much it changes with half the timestep
};

// Of one step.
struct StepGate {
  std::vector<ComponentGate> components = {};
  // Over which creep and penetration turn a part: the pads' smaller half extent, metres.
  double arm = 1;
  double creep = 0;         // metres, of a held part in the time that the step takes
  double penetration = 0;   // metres, the deepest contact
  double force_ripple = 0;  // newtons, spread of the wrist's force while nothing moves

  // All that adds up for a claim; offsets count twice, because noise may change them. Of a
  // precondition: what adds up for the poses that it speaks of.
  double For(const Claim& claim) const;
};

struct HonestyGate {
  std::vector<StepGate> steps = {};  // by StepId; empty: nothing is forgiven

  double For(const Claim& claim) const;
};

// Executes the plan twice without noise, once with half the timestep, and holds the hand still at
// the end of each step.
HonestyGate MeasureGate(const domain::Problem& problem, const plan::Plan& plan,
                        const scene::SceneOptions& scene);

}  // namespace assay::check
