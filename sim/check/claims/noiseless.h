#pragma once

#include <vector>

#include "sim/check/claims/claim.h"
#include "sim/check/trial/noisy_trial.h"

namespace assay::check {

// What is wrong with a plan before any error is drawn.
struct Noiseless {
  std::vector<Claim> violated;  // claims that do not even hold without noise
  // Claims that nobody can test: what the engine makes of them without noise is wider than what the
  // certificate says (HonestyGate::Hides).
  std::vector<Claim> hidden;

  bool Holds() const { return violated.empty() && hidden.empty(); }
};

// Executes the plan without noise. Attempts and trials under noise say something only of a plan
// that holds there.
Noiseless ExecuteWithoutNoise(const Experiment& experiment);

}  // namespace assay::check
