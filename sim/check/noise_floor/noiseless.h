#pragma once

#include <vector>

#include "sim/check/certificate_claims/claim.h"
#include "sim/check/trial_verdicts/trial.h"

namespace assay::check {

// The defects of a plan that show before any error is drawn.
struct Noiseless {
  std::vector<Claim> violated;  // claims that do not hold even without noise
  // Claims that nobody can test: the noise floor is wider than the certified interval
  // (NoiseFloor::Hides).
  std::vector<Claim> hidden;

  bool Holds() const { return violated.empty() && hidden.empty(); }
};

// Executes the plan without noise, and compares it with its certificates and the noise floor.
// Trials under noise prove something only about a plan whose result Holds().
Noiseless ExecuteWithoutNoise(const Experiment& experiment);

}  // namespace assay::check
