#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "planner/base/id.h"

namespace assay::posting {

using StepId = Id<struct PartialStepTag>;  // index in PartialPlan::steps()

// The ordering constraints prior_to(a, b) of a partial plan: a directed graph with one node per
// step, consistent as long as it has no cycle (Spar, "Ordering Constraints in Operational
// Planning"). The transitive closure is kept, so a test takes constant time and a post linear.
class OrderingGraph {
 public:
  StepId AddStep();

  // prior_to(a, b). False, and nothing changes, if that would close a cycle.
  bool Post(StepId a, StepId b);
  bool Before(StepId a, StepId b) const;  // by the constraints and their closure

  int step_count() const { return static_cast<int>(after_.size()); }
  std::span<const std::pair<StepId, StepId>> arcs() const { return arcs_; }  // as posted

  // Orders of all steps that satisfy the constraints, in lexicographic order of step indices, at
  // most `most` of them.
  std::vector<std::vector<StepId>> Linearizations(int most) const;

 private:
  std::vector<std::vector<bool>> after_;  // after_[a][b]: a before b
  std::vector<std::pair<StepId, StepId>> arcs_;
};

}  // namespace assay::posting
