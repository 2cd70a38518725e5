#include "sim/execution/interpretation/planned_worlds.h"

#include <algorithm>

namespace assay::execution {

const plan::Plan* PlannedWorlds::PlanOf(int world) const {
  for (const assembly::PlanOfWorlds& planned : assembly.plans) {
    if (std::ranges::count(planned.worlds, world) > 0) return &planned.plan;
  }
  return nullptr;
}

}  // namespace assay::execution
