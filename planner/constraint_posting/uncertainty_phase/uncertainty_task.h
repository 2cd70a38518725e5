#pragma once

#include <cstdint>
#include <optional>

#include "planner/constraint_posting/uncertainty_phase/augmentation/best_known.h"
#include "planner/constraint_posting/uncertainty_phase/uncertainty_options.h"
#include "planner/uncertainty/error_sets/world_tree.h"

namespace assay::constraint_posting {

// The data shared by all work on the uncertainty in plan instances of one problem. Its world trees
// record what is known during execution.
struct UncertaintyTask {
  // Both arguments must outlive the object, and the options must have resolvers.
  UncertaintyTask(const domain::Problem& of, const UncertaintyOptions& with)
      : problem(of), options(with), possible(of, with.propagation, with.bound) {
    if (BestKnown::Bounds(of, with.propagation)) best.emplace(of, with.propagation, with.bound);
  }

  std::int64_t snapshots() const { return possible.size() + (best ? best->snapshots() : 0); }

  const domain::Problem& problem;
  const UncertaintyOptions& options;
  uncertainty::WorldTree possible;
  std::optional<BestKnown> best;  // present only if it bounds the effect of all remedies
};

}  // namespace assay::constraint_posting
