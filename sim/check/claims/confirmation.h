#pragma once

#include <functional>
#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/scene/mjcf.h"

namespace assay::check {

// The same scene with half the timestep: what changes is the engine's, not the world's.
scene::SceneOptions Finer(scene::SceneOptions options);

// No claim is called violated before the same was executed with half the timestep: `finer` does
// so, and is called only if something is violated.
//
// Errors of an engine of first order in the timestep are halved, so that what is left of a margin
// when the timestep goes to 0 is as much beyond the finer one as that is beyond the coarse one
// (Richardson). So much is known of the engine in this very case, and subtracted. It does not
// matter whether the finer execution still claims what it observes: outside is outside. What it
// does not observe, since it did not come there or it did not happen, is inconclusive, unless it
// violates something else.
std::vector<Claim> Confirmed(std::vector<Claim> claims,
                             const std::function<std::vector<Claim>()>& finer);

}  // namespace assay::check
