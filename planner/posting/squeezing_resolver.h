#pragma once

#include "planner/posting/resolver.h"

namespace assay::posting {

// Squeezes parts whose errors make a goal fail, at the latest moment before the step at which the
// hand is empty and the part alone: for each closing direction in the world the grasp that leans
// least. Two squeezes in perpendicular directions bound both horizontal coordinates by the hand's
// error; one never does (facts of Spar's propagation).
class SqueezingResolver : public Resolver {
 public:
  std::string_view name() const override { return "squeezing"; }
  std::vector<Remedy> Propose(const UnmetGoals& unmet) override;
};

}  // namespace assay::posting
