#pragma once

#include <cstdint>
#include <optional>

#include "planner/posting/uncertainty_phase/instances/best_known.h"
#include "planner/posting/uncertainty_phase/uncertainty_options.h"
#include "planner/uncertainty/errors/world_tree.h"

namespace assay::posting {

// What all that is done about the uncertainty in plan instances of a problem shares: above all what
// is known as they are executed, one way and another.
struct UncertaintyTask {
  // Both must outlive it; the options have resolvers.
  UncertaintyTask(const domain::Problem& of, const UncertaintyOptions& with)
      : problem(of), options(with), possible(of, with.propagation, with.bound) {
    if (BestKnown::Bounds(of, with.propagation)) best.emplace(of, with.propagation, with.bound);
  }

  std::int64_t moments() const { return possible.size() + (best ? best->moments() : 0); }

  const domain::Problem& problem;
  const UncertaintyOptions& options;
  uncertainty::WorldTree possible;
  std::optional<BestKnown> best;  // where it bounds what remedies can reach
};

}  // namespace assay::posting
