#pragma once

#include <vector>

#include "planner/assembly/contingent_assembly.h"

namespace assay::execution {

// The worlds of a scenario, and their plans as one contingent plan.
struct PlannedWorlds {
  std::vector<domain::Problem> worlds;
  assembly::ContingentAssembly assembly;

  // Returns the plan that the interpretation of an assembly has for a world; null if the world has
  // none.
  const plan::Plan* PlanOf(int world) const;
};

}  // namespace assay::execution
