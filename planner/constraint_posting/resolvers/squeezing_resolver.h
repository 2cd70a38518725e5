#pragma once

#include "planner/constraint_posting/resolvers/resolver.h"

namespace assay::constraint_posting {

// Proposes to squeeze parts whose errors make a goal fail. A squeeze is inserted before the step,
// as late as possible while the hand is empty and the part is alone. For each direction in which
// the fingers can close, the resolver uses the grasp that leans least. The resolver proposes single
// squeezes, and pairs of squeezes in two directions, one after the other. Two squeezes in
// perpendicular directions bound both horizontal coordinates by the hand's error; one squeeze never
// does. A squeeze has goals of its own, so each proposal is also made with sensing right before the
// squeeze.
class SqueezingResolver : public Resolver {
 public:
  std::string_view name() const override { return "squeezing"; }
  std::vector<Remedy> Propose(const UnmetGoals& unmet) override;
  // Returns the parts that the hand would meet in every grasp that closes in some direction.
  std::vector<domain::PartId> Obstacles(const UnmetGoals& unmet) const override;
};

}  // namespace assay::constraint_posting
