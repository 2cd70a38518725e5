#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/contingent/grounding/ground_task.h"

namespace assay::contingent {

using NodeId = Id<struct PlanNodeTag>;
using LoopId = Id<struct LoopTag>;  // nodes that repeats lead round

// One step of a contingent plan, and where it goes on.
struct PlanNode {
  enum class Kind {
    kGoal,     // the goal is known to hold: nothing more is done
    kAct,      // execute the action, go on with the only child
    kWhether,  // the formula is known by now: the first child if it is true, the second if it is
               // not
    kValue,    // the function's value is known by now: the child of that value
  };
  Kind kind = Kind::kGoal;
  ActionId action;
  FormulaId formula;
  FunctionId function;
  std::vector<AtomId> values = {};  // of kValue, as many as children
  std::vector<NodeId> children = {};
  // By child: whether it is a node above, so that what lies between is repeated until another
  // outcome is sensed. Empty: none is.
  std::vector<bool> repeats = {};

  bool Repeats(std::size_t child) const { return !repeats.empty() && repeats[child]; }

  bool operator==(const PlanNode&) const = default;
};

// A contingent plan: a tree whose equal sub-plans are one node. Nodes are in any order.
struct PlanTree {
  std::vector<PlanNode> nodes;
  NodeId root;

  const PlanNode& node(NodeId id) const { return nodes[id.index()]; }
};

// Of the tree as it unfolds, each repeat once.
struct TreeSize {
  int depth = 0;    // actions on the longest way to a leaf
  int nesting = 0;  // branch points on the way with most of them
  double leaves = 0;
  double branch_points = 0;
  int actions = 0;  // nodes that act, shared ones once
  int nodes = 0;
  int repeats = 0;
};
TreeSize SizeOf(const PlanTree& tree);

// The nodes that the root leads to, children before parents but for repeats.
std::vector<NodeId> ChildrenFirst(const PlanTree& tree);

// By node a number that it has in common with those to which it leads and which lead back to it;
// none of those that the root does not lead to.
std::vector<LoopId> LoopsOf(const PlanTree& tree);

// The nodes that the root leads to, renumbered.
PlanTree Trimmed(const PlanTree& tree);

}  // namespace assay::contingent
