#pragma once

#include <vector>

#include "planner/assembly/contingent_assembly.h"

namespace assay::enact {

// The plans of a scenario's worlds, as one tree.
struct PlannedWorlds {
  std::vector<domain::Problem> worlds;
  assembly::ContingentAssembly assembly;

  // The plan of a world (null: it has none).
  const plan::Plan* PlanOf(int world) const;
};

}  // namespace assay::enact
