#pragma once

#include <optional>

#include "planner/contingent/knowledge/knowledge_space.h"
#include "planner/contingent/tree/plan_tree.h"

namespace assay::contingent {

struct ExhaustiveTree {
  std::optional<PlanTree> tree;
  // The tree repeats: it reaches the goal if no outcome of sensing is put off for ever. Without
  // repeats there is no plan.
  bool repeats = false;
  // All states that can be reached have been looked at. Without a tree this is a proof of none.
  bool is_complete = false;
};

// The plan tree of least depth, the number of actions on its longest way, by looking at the states
// in the order of their distance. If there is no such tree, one with repeats (a strong cyclic plan:
// Cimatti, Pistore, Roveri and Traverso 2003), where what a repeated branch asks of is open in
// every world anew: sensing the same thing twice tells the same. For small problems: all states are
// kept. Ends early when the space's budget is spent.
ExhaustiveTree FindExhaustiveTree(KnowledgeSpace& space);

}  // namespace assay::contingent
