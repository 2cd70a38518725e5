#pragma once

#include "planner/constraint_posting/resolvers/resolver.h"

namespace assay::constraint_posting {

// Proposes looks at parts whose errors make a goal fail, with one or more of the available sensors.
// A look is inserted before the step, as late as possible while the part still lies free (Spar,
// "Satisfying Uncertainty-Reduction Goals").
class SensingResolver : public Resolver {
 public:
  std::string_view name() const override { return "sensing"; }
  bool disturbs() const override { return false; }
  std::vector<Remedy> Propose(const UnmetGoals& unmet) override;
};

}  // namespace assay::constraint_posting
