#include "sim/scene/exchange/exported_body.h"

namespace assay::scene {

std::vector<ExportedBody> ExportedPair(const domain::Problem& problem,
                                       const domain::Mating& mating) {
  const domain::Part& fixed = problem.part(mating.fixed);
  const domain::Part& held = problem.part(mating.held);
  return {{.name = fixed.name, .model = fixed.model, .is_fixed = true},
          {.name = held.name, .model = held.model, .X_WorldPart = mating.X_FixedHeld}};
}

}  // namespace assay::scene
