#pragma once

#include <functional>
#include <vector>

#include "sim/check/certificate_claims/claim.h"
#include "sim/scene/mjcf.h"

namespace assay::check {

// Returns the same scene with half the timestep. What changes with the timestep is an error of the
// engine, not of the world.
scene::SceneOptions Finer(scene::SceneOptions options);

// Returns the claims after the engine's own error, found by an execution at half the timestep, was
// subtracted from every violated one. `finer` makes that execution, and is called only if a claim
// is violated.
//
// If the engine's error is of first order in the timestep, half the timestep halves the error. The
// limit for a timestep of 0 then differs from the finer value by as much as the finer value differs
// from the coarse one (Richardson extrapolation). This difference is the engine's error in this
// very case, and it is subtracted. The observed value of the finer execution counts even if nothing
// is claimed about this value in the finer execution. If the finer execution does not observe the
// claim at all, the claim is inconclusive, unless the finer execution violates another claim. An
// execution does not observe a claim if the execution ends too early, or if the event that is to be
// observed does not happen.
std::vector<Claim> Confirmed(std::vector<Claim> claims,
                             const std::function<std::vector<Claim>()>& finer);

}  // namespace assay::check
