#pragma once

#include "planner/posting/resolvers/resolver.h"

namespace assay::posting {

// Squeezes parts whose errors make a goal fail, at the latest moment before the step at which the
// hand is empty and the part alone: for each closing direction in the world with the grasp that
// leans least, in one direction, or in two one after the other. Two squeezes in perpendicular
// directions bound both horizontal coordinates by the hand's error; one never does. Because a
// squeeze has goals of its own, each is also proposed with sensing right before it.
class SqueezingResolver : public Resolver {
 public:
  std::string_view name() const override { return "squeezing"; }
  std::vector<Remedy> Propose(const UnmetGoals& unmet) override;
  // Parts that the hand would meet in every grasp that closes in some direction.
  std::vector<domain::PartId> Obstacles(const UnmetGoals& unmet) const override;
};

}  // namespace assay::posting
