#pragma once

#include <optional>

#include "planner/contingent/knowledge/knowledge_space.h"
#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::contingent {

struct FirstTree {
  std::optional<PlanTree> tree;
  // True if no sequence of steps reaches the goal, even if every sensing action has the outcome
  // that the search wants. Then there is no plan. If there is no tree and this is false, the search
  // has given up.
  bool is_proof_of_none = false;
};

// Finds a plan tree fast. The tree is not necessarily the least deep or the smallest one. From a
// state, the search looks for one path to the goal or to a state that a completed sub-plan serves.
// It first tries paths without sensing. Then it follows the relaxed knowledge graph and assumes the
// best outcome of every sensing action. Afterwards it looks for paths from the other outcomes, from
// the end of the path to its start, so that completed sub-plans can be reused. If another outcome
// of a step leads nowhere, the step is banned and the search looks for another path. The search
// ends early when the space's budget is spent.
FirstTree FindFirstTree(KnowledgeSpace& space);

}  // namespace assay::contingent
