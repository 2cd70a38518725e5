#include "sim/check/noise_floor/noiseless.h"

namespace assay::check {

Noiseless ExecuteWithoutNoise(const Experiment& experiment) {
  Noiseless noiseless;
  for (Claim& claim : RunTrial(experiment, {}, {.sample_rate = 0}).claims) {
    if (claim.IsViolated()) {
      noiseless.violated.push_back(std::move(claim));
    } else if (experiment.gate.Hides(claim, experiment.problem.clearance)) {
      noiseless.hidden.push_back(std::move(claim));
    }
  }
  return noiseless;
}

}  // namespace assay::check
