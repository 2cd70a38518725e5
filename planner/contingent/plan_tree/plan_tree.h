#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

using NodeId = Id<struct PlanNodeTag>;
using LoopId = Id<struct LoopTag>;  // a set of nodes that repeats connect in a cycle

// One step of a contingent plan, and the nodes that follow it.
struct PlanNode {
  enum class Kind {
    kGoal,  // the goal is known to hold; nothing more is done
    kAct,   // execute the action and continue with the only child
    // the formula is known by then: continue with the first child if it is true, with the second if
    // false
    kWhether,
    kValue,  // the function's value is known by then: continue with the child of this value
  };
  Kind kind = Kind::kGoal;
  ActionId action;
  FormulaId formula;
  FunctionId function;
  std::vector<AtomId> values = {};  // for kValue: one value for each child
  std::vector<NodeId> children = {};
  // Indexed by child: true if the child is a node above this one. The nodes between the two are
  // then repeated until another outcome is sensed. The vector is empty if no child is a node above.
  std::vector<bool> repeats = {};

  bool Repeats(std::size_t child) const { return !repeats.empty() && repeats[child]; }

  bool operator==(const PlanNode&) const = default;
};

// A contingent plan: a tree whose equal sub-plans are one node. The nodes are in any order.
struct PlanTree {
  std::vector<PlanNode> nodes;
  NodeId root;

  const PlanNode& node(NodeId id) const { return nodes[id.index()]; }
};

// The size of the unfolded tree. Each repeat is counted once.
struct TreeSize {
  int depth = 0;    // the number of actions on the longest path to a leaf
  int nesting = 0;  // the greatest number of branch points on a path
  double leaves = 0;
  double branch_points = 0;
  int actions = 0;  // the number of action nodes; shared nodes count once
  int nodes = 0;
  int repeats = 0;
};
TreeSize SizeOf(const PlanTree& tree);

// Returns the nodes that can be reached from the root. Children come before their parents, except
// at repeats.
std::vector<NodeId> ChildrenFirst(const PlanTree& tree);

// Returns a loop number for each node. Two nodes have the same number if each of them leads to the
// other. Nodes that cannot be reached from the root have none.
std::vector<LoopId> LoopsOf(const PlanTree& tree);

// Returns the tree of the nodes that can be reached from the root, renumbered.
PlanTree Trimmed(const PlanTree& tree);

}  // namespace assay::contingent
