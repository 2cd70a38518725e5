#pragma once

#include "sim/check/falsification/attack_result.h"

namespace assay::check {

// Makes a violation as simple as possible, by executing the plan again and again from its start up
// to the step in question: errors are left out one by one where the claim stays violated without
// them; what is left is made smaller together.
Counterexample Shrunk(const Experiment& experiment, const WorstClaim& violation);

// The claim as it comes out when the plan is executed up to its step. None: it does not come there.
std::optional<Claim> Replayed(const Experiment& experiment, const Claim& claim,
                              const noise::Noise& noise);

}  // namespace assay::check
