#pragma once

#include "sim/check/trial_verdicts/trial.h"

namespace assay::cli {

// Executes a plan once without noise, in order to show it. Shows progress to people.
check::Trial NoiselessTrial(const check::Experiment& experiment);

}  // namespace assay::cli
