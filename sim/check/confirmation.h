#pragma once

#include <functional>
#include <vector>

#include "sim/check/claim.h"
#include "sim/scene/mjcf.h"

namespace assay::check {

// The same scene with half the timestep: what changes is the engine's, not the world's.
scene::SceneOptions Finer(scene::SceneOptions options);

// No claim is called violated before the same was executed with half the timestep: `finer` does
// so, and is called only if something is violated.
//
// Errors of an engine of first order in the timestep are halved, so that what is left of a margin
// when the timestep goes to 0 is as much beyond the finer one as that is beyond the coarse one
// (Richardson). Gates widen by so much; of a claim that the finer execution does not make, they
// widen to all of its margin.
std::vector<Claim> Confirmed(std::vector<Claim> claims,
                             const std::function<std::vector<Claim>()>& finer);

}  // namespace assay::check
