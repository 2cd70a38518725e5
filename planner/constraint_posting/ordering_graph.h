#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "planner/base/id.h"

namespace assay::constraint_posting {

using StepId = Id<struct PartialStepTag>;  // index in PartialPlan::steps()

// The ordering constraints prior_to(a, b) of a partial plan: a directed graph with one node for
// each step, consistent as long as it has no cycle (Spar, "Ordering Constraints in Operational
// Planning"). The class stores the transitive closure, so a test takes constant time and a post
// linear time.
class OrderingGraph {
 public:
  StepId AddStep();

  // Posts prior_to(a, b). Returns false and changes nothing if that would close a cycle.
  bool Post(StepId a, StepId b);
  bool Before(StepId a, StepId b) const;  // true by the constraints and their closure

  int step_count() const { return static_cast<int>(after_.size()); }
  // the constraints as posted
  std::span<const std::pair<StepId, StepId>> arcs() const { return arcs_; }

  // Returns at most `most` orders of all steps that satisfy the constraints, in lexicographic order
  // of step indices.
  std::vector<std::vector<StepId>> Linearizations(int most) const;

 private:
  std::vector<std::vector<bool>> after_;  // after_[a][b] is true if a comes before b
  std::vector<std::pair<StepId, StepId>> arcs_;
};

}  // namespace assay::constraint_posting
