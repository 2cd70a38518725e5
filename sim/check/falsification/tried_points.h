#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "sim/check/falsification/tried_step.h"

namespace assay::check {

// The points of the error box at which a step is attempted. All functions return samples that were
// not made yet. `seed` chooses among the corners and the even points that there are.

// Returns corners of a design that shows the effects of errors. A corner and its opposite use the
// same start, so that effects of starts are not mistaken for effects of errors.
std::vector<Sample> DesignCorners(TriedStep& step, std::uint64_t seed, std::int64_t count);

// Returns the corners at which claims are likely to be extreme, judged by the samples so far.
// Corners with the least expected margins come first, and none is repeated.
std::vector<Sample> LikelyCorners(TriedStep& step, std::int64_t count);

// Returns points that fill the box evenly. They are divided among the claims that the attempts at
// the step try to violate (TriedStep::aims).
std::vector<Sample> EvenPoints(TriedStep& step, std::uint64_t seed, std::int64_t count);

// Returns the samples with the least margin of each claim, the least first. Claims without width
// are left out, since any sample attains them.
std::vector<std::pair<ClaimKey, const Sample*>> LeastMargins(TriedStep& step);

// Returns a claim's margin as a length (AsLength).
double Length(const Claim& claim);
// Returns an attempt's claim with this key, or null if there is none.
const Claim* Find(const std::vector<Claim>& claims, const ClaimKey& key);

}  // namespace assay::check
