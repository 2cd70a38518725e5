#pragma once

#include "planner/constraint_posting/resolvers/resolver.h"

namespace assay::constraint_posting {

// Proposes looks at parts whose errors make a goal fail, with one or more of the available sensors.
// A look comes at the latest time before the step at which the part lies free (Spar, "Satisfying
// Uncertainty-Reduction Goals").
class SensingResolver : public Resolver {
 public:
  std::string_view name() const override { return "sensing"; }
  bool disturbs() const override { return false; }
  std::vector<Remedy> Propose(const UnmetGoals& unmet) override;
};

}  // namespace assay::constraint_posting
