#pragma once

#include <optional>
#include <string>

#include "planner/contingent/knowledge/knowledge_space.h"
#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::contingent {

struct ExhaustiveTree {
  std::optional<PlanTree> tree = {};
  // True if the tree has repeats. Such a tree reaches the goal if no outcome of sensing is avoided
  // for ever. There is then no plan without repeats.
  bool repeats = false;
  // True if all reachable states have been visited. Without a tree, this proves that there is no
  // plan, with or without repeats.
  bool is_complete = false;
  // Says why nothing is proved, although all reachable states have been visited.
  std::string doubt = {};
};

// Finds the plan tree of least depth, which is the number of actions on its longest path. The
// search visits the states in the order of their distance. If there is no such tree, it looks for a
// tree with repeats (a strong cyclic plan: Cimatti, Pistore, Roveri and Traverso 2003). The
// question of a repeated branch must be open again in every world, because sensing the same fact
// twice gives the same result. The search keeps all states, so it is for small problems. It ends
// early when the space's budget is spent.
ExhaustiveTree FindExhaustiveTree(KnowledgeSpace& space);

}  // namespace assay::contingent
