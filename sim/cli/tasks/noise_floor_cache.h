#pragma once

#include <string_view>

#include "sim/check/certificate_claims/noise_floor.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {

// Returns check::MeasureNoiseFloor of the plan, which is measured only once. The user's cache
// folder (assay/noise-floor in XDG_CACHE_HOME, or in .cache of HOME) keeps it by a hash of all that
// it depends on: this program, the engine, each file that was read, the command with its options,
// the plan and the scene. If there is no cache folder, or if it cannot be written, the floor is
// measured each time.
check::NoiseFloor KeptNoiseFloor(const PlannedProblem& planned, std::string_view command);

}  // namespace assay::cli
