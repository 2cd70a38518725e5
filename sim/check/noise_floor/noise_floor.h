#pragma once

#include <string>
#include <vector>

#include "planner/plan/data/plan.h"
#include "sim/check/certificate_claims/claim.h"
#include "sim/scene/mjcf.h"

namespace assay::check {

// The noise floor: the engine's own errors in an execution of a plan without any other error. Known
// errors of the engine are subtracted from observations under noise. Observations within the
// engine's unknown errors prove nothing about a prediction.

// The part of the noise floor that belongs to one claim, in the claim's unit.
struct ClaimNoiseFloor {
  Claimed about = Claimed::kAfter;
  std::string name;   // the name as in Claim
  double offset = 0;  // the observed value without noise; 0 for a precondition
  double step_size = 0;
};

// The part of the noise floor that belongs to one step. Lengths are in metres, angles in radians.
struct StepNoiseFloor {
  std::vector<ClaimNoiseFloor> components = {};
  double arm = 1;
  // Depth of the deepest contact while the hand is kept still, which it is also while it squeezes.
  double penetration = 0;
  double lag = 0;  // distance of the hand from its commanded place
  double lag_turn = 0;
};

// The greatest distance in metres by which the engine may let a part creep within a step that
// leaves the part in its place.
inline constexpr double kMostCreep = 2e-5;

// The distance in metres and the angle in radians that no execution in the engine resolves. Its
// contacts are soft, and let parts that rest or are held creep. In plans for errors of a few
// micrometres, parts were up to 0.8 micrometres and 0.6 microradians beyond what is certain.
inline constexpr double kLengthResolution = 1e-6;
inline constexpr double kAngleResolution = 1e-5;

struct NoiseFloor {
  std::vector<StepNoiseFloor> steps = {};  // by StepId; empty: nothing is known but rounding

  // Returns the claim with its prediction widened by the known errors of the engine, and with its
  // gate set. Penetration and lag widen the prediction at both ends, also by the turn that they
  // give to a part whose origin is away from its body (Lever). So does the creep of a fixed part
  // without noise, up to kMostCreep. The effect of the timestep has a
  // sign, and it vanishes in proportion to the timestep or faster. The effect is therefore one to
  // two times the change that half the timestep makes. This change counts as known. The gate is as
  // large as this change and the engine's resolution together.
  Claim Passed(Claim claim) const;
  // Returns how wrong a prediction may be at one end without being noticed.
  double Floor(const Claim& claim) const;
  // Returns whether the floor of a claim from Passed is greater than the width of its certified
  // interval. Preconditions have no width. A set whose width is within what penetration, lag and
  // the engine's resolution add at both ends counts as a set without a width. The floor of such
  // claims is compared with the clearance instead, in metres, or with the clearance over the arm
  // for angles.
  bool Hides(const Claim& passed, double clearance) const;
};

}  // namespace assay::check
