#include "planner/contingent/plan_tree/plan_tree.h"

#include <algorithm>
#include <ranges>
#include <utility>

namespace assay::contingent {

std::vector<NodeId> ChildrenFirst(const PlanTree& tree) {
  std::vector<NodeId> order;
  std::vector<char> is_seen(tree.nodes.size(), 0);
  std::vector<std::pair<NodeId, std::size_t>> path = {{tree.root, 0}};
  is_seen[tree.root.index()] = 1;
  while (!path.empty()) {
    auto& [id, next] = path.back();
    const std::vector<NodeId>& children = tree.node(id).children;
    if (next == children.size()) {
      order.push_back(id);
      path.pop_back();
      continue;
    }
    const NodeId child = children[next++];
    if (std::exchange(is_seen[child.index()], 1) == 0) path.emplace_back(child, 0);
  }
  return order;
}

TreeSize SizeOf(const PlanTree& tree) {
  struct Below {
    int depth = 0;
    int nesting = 0;
    double leaves = 0;
    double branch_points = 0;
  };
  std::vector<Below> below(tree.nodes.size());
  TreeSize size;
  for (const NodeId id : ChildrenFirst(tree)) {
    const PlanNode& node = tree.node(id);
    Below& here = below[id.index()];
    const bool acts = node.kind == PlanNode::Kind::kAct;
    if (node.kind == PlanNode::Kind::kGoal) here.leaves = 1;
    const bool branches = node.children.size() > 1;
    here.branch_points = branches ? 1 : 0;
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      if (node.Repeats(i)) continue;
      const Below& child = below[node.children[i].index()];
      here.depth = std::max(here.depth, child.depth + (acts ? 1 : 0));
      here.nesting = std::max(here.nesting, child.nesting + (branches ? 1 : 0));
      here.leaves += child.leaves;
      here.branch_points += child.branch_points;
    }
    ++size.nodes;
    size.actions += acts ? 1 : 0;
    size.repeats += static_cast<int>(std::count(node.repeats.begin(), node.repeats.end(), true));
  }
  const Below& root = below[tree.root.index()];
  size.depth = root.depth;
  size.nesting = root.nesting;
  size.leaves = root.leaves;
  size.branch_points = root.branch_points;
  return size;
}

// Computes strongly connected components by the algorithm of Kosaraju and Sharir. The second search
// goes against the arcs, in the reverse order in which the first search finished the nodes.
std::vector<LoopId> LoopsOf(const PlanTree& tree) {
  const std::vector<NodeId> order = ChildrenFirst(tree);
  std::vector<std::vector<NodeId>> parents(tree.nodes.size());
  for (const NodeId id : order) {
    for (const NodeId child : tree.node(id).children) parents[child.index()].push_back(id);
  }
  std::vector<LoopId> loops(tree.nodes.size());
  int count = 0;
  for (const NodeId last : std::views::reverse(order)) {
    std::vector<NodeId> open;
    const auto join = [&](NodeId id) {
      if (!loops[id.index()].IsNone()) return;
      loops[id.index()] = LoopId(count);
      open.push_back(id);
    };
    for (join(last); !open.empty();) {
      const NodeId id = open.back();
      open.pop_back();
      for (const NodeId parent : parents[id.index()]) join(parent);
    }
    ++count;
  }
  return loops;
}

PlanTree Trimmed(const PlanTree& tree) {
  PlanTree trimmed;
  std::vector<NodeId> renumbered(tree.nodes.size());
  const std::vector<NodeId> order = ChildrenFirst(tree);
  for (std::size_t i = 0; i < order.size(); ++i) renumbered[order[i].index()] = NodeId(i);
  for (const NodeId id : order) {
    trimmed.nodes.push_back(tree.node(id));
    for (NodeId& child : trimmed.nodes.back().children) child = renumbered[child.index()];
  }
  trimmed.root = renumbered[tree.root.index()];
  return trimmed;
}

}  // namespace assay::contingent
