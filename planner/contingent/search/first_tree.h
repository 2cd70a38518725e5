#pragma once

#include <optional>

#include "planner/contingent/knowledge/knowledge_space.h"
#include "planner/contingent/tree/plan_tree.h"

namespace assay::contingent {

struct FirstTree {
  std::optional<PlanTree> tree;
  // No sequence of steps reaches the goal, even if every sensing action told what is hoped for: so
  // there is no plan. Without a tree and without this, the search has given up.
  bool is_proof_of_none = false;
};

// A plan tree, found fast: neither the least deep nor the smallest. From a state the search looks
// for one way to the goal or to a state that a completed sub-plan serves, first without sensing,
// then by the relaxed knowledge graph, hoping for the best of every sensing action; then for ways
// from the other outcomes, the last ones first, so that what has been completed serves again. A
// step whose other outcome leads nowhere is banned and another way looked for. Ends early when the
// space's budget is spent.
FirstTree FindFirstTree(KnowledgeSpace& space);

}  // namespace assay::contingent
