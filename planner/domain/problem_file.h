#pragma once

#include <filesystem>

#include "planner/base/document.h"
#include "planner/domain/problem.h"
#include "planner/domain/units.h"

namespace assay::domain {

// Reads the problem in a scenario file ("assay-scenario/1"): title, description, units, workcell,
// rules (those of the workcell that this scenario replaces), clearance, parts, gripper, sensing,
// `initially` (matings that hold at the start, written like goals), and goal. `models` is the
// folder with parts/ and workcells/. The key `simulation` is left to sim/scenario. Throws
// InputError for what is wrong, with the place. scenarios/README.md describes the format.
Problem ReadProblem(const Document& scenario, const std::filesystem::path& models);

}  // namespace assay::domain
