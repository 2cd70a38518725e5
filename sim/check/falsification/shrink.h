#pragma once

#include "sim/check/falsification/falsification_result.h"

namespace assay::check {

// Makes a violation as simple as possible. The plan is executed again and again from its start up
// to the step in question. Errors are left out one by one where the claim stays violated without
// them; the rest are made smaller together.
Counterexample Shrunk(const Experiment& experiment, const WorstClaim& violation);

// Returns the claim's result when the plan is executed up to the claim's step. It is missing if the
// execution does not observe the claim.
std::optional<Claim> Replayed(const Experiment& experiment, const Claim& claim,
                              const noise::Noise& noise);

}  // namespace assay::check
