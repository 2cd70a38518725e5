#pragma once

#include <functional>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/scene/mjcf.h"

namespace assay::check {

// Returns the same scene with half the timestep. What changes with the timestep is an error of the
// engine, not of the world.
scene::SceneOptions Finer(scene::SceneOptions options);

// Returns the claims after every violated one was compared with an execution at half the timestep.
// `finer` makes that execution, and is called only if a claim is violated.
//
// If the engine's error is of first order in the timestep, half the timestep halves it. The limit
// for a timestep of 0 is then as far beyond the finer value as that is beyond the coarse one
// (Richardson extrapolation). The engine's share in this very case is thereby known, and is
// subtracted. It does not matter whether the finer execution claims its observation: a value
// outside is outside. If the finer execution does not observe the claim, because it did not come
// there or it did not happen, the claim is inconclusive, unless that execution violates another
// claim.
std::vector<Claim> Confirmed(std::vector<Claim> claims,
                             const std::function<std::vector<Claim>()>& finer);

}  // namespace assay::check
