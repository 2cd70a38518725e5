#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/algebra/bounds/bounds.h"
#include "planner/constraint_posting/objection.h"
#include "planner/constraint_posting/resolvers/resolver.h"
#include "planner/plan/data/plan.h"

namespace assay::constraint_posting {

struct UncertaintyOptions {
  uncertainty::Propagation propagation = uncertainty::Propagation::kSound;
  algebra::BoundRequest bound = {};
  int most_remedies = 3;  // the greatest number of remedies at once for one step
  // the greatest number of combinations of remedies tried for one step
  std::int64_t combinations = 100;
  // the number of plan instances considered at first, over all plans
  std::int64_t instances = 10;
  // snapshots of world trees, for each search for a plan with fewer errors
  std::int64_t snapshots = 12'000;
  // the number of instances that may be augmented in the hope of a smaller violation alone, without
  // hope of fewer unproved steps
  std::int64_t instances_for_violation = 0;
  std::vector<std::shared_ptr<Resolver>> resolvers = {};  // empty: sensing, then squeezing
  // sensing actions with which every plan begins, even if the plan does not need them
  std::vector<plan::Action> looks = {};
  // Called for each plan instance of the first phase before it is augmented. An instance that
  // cannot be executed is skipped. Without a function, all instances can be executed.
  std::function<bool(const plan::Plan&)> can_be_executed = {};
  // Judges the actions of instances before the uncertainty phase does. May be empty.
  Judge judge = {};

  // Returns the conditions that some remedy may absorb.
  std::vector<plan::Condition> Absorbable() const;
};

// Returns the options with the default resolvers if they have none.
UncertaintyOptions WithDefaults(UncertaintyOptions options);

}  // namespace assay::constraint_posting
