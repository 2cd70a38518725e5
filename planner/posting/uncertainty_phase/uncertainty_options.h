#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "planner/algebra/bounds/bounds.h"
#include "planner/plan/data/plan.h"
#include "planner/posting/resolvers/resolver.h"

namespace assay::posting {

struct UncertaintyOptions {
  uncertainty::Propagation propagation = uncertainty::Propagation::kSound;
  algebra::BoundRequest bound = {};
  int most_remedies = 3;            // at once, for one step
  std::int64_t combinations = 100;  // of remedies, tried for one step
  std::int64_t instances = 10;      // plan instances looked at first, of all plans
  std::int64_t moments = 12'000;    // of world trees, for each search for a plan with fewer errors
  std::int64_t instances_for_violation = 0;  // of these, augmented for a smaller violation alone
  std::vector<std::shared_ptr<Resolver>> resolvers = {};  // empty: sensing, then squeezing
  std::vector<plan::Sense> looks =
      {};  // with which every plan begins, whether it needs them or not
  // Asked of each plan instance of the first phase before it is augmented: those that cannot be
  // executed are passed over. Empty: all can be.
  std::function<bool(const plan::Plan&)> can_be_executed = {};

  // Conditions that some remedy may absorb.
  std::vector<std::string> Absorbable() const;
};

// With the resolvers that are meant where none are given.
UncertaintyOptions WithDefaults(UncertaintyOptions options);

}  // namespace assay::posting
