#pragma once

#include "sim/check/trial_verdicts/trial.h"

namespace assay::cli {

// Executes a plan once without noise, for a page. Shows progress to people, and can be interrupted.
check::Trial NoiselessTrial(const domain::Problem& problem, const plan::Plan& plan,
                            const scene::Scene& scene);

}  // namespace assay::cli
