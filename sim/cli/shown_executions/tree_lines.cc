#include "sim/cli/shown_executions/tree_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "planner/contingent/plan_tree/tree_text.h"

namespace assay::cli {
namespace {

using contingent::NodeId;
using contingent::PlanNode;

// Returns "A" for 1, "Z" for 26, "AA" for 27. Steps of an execution have numbers, so shared nodes
// of the tree have letters.
std::string LettersOf(int number) {
  std::string letters;
  for (; number > 0; number = (number - 1) / 26) {
    letters.insert(letters.begin(), static_cast<char>('A' + (number - 1) % 26));
  }
  return letters;
}

class TreeLister {
 public:
  TreeLister(const contingent::GroundTask& task, const contingent::PlanTree& tree,
             const execution::Walk& walk, const std::map<std::string, std::string>& words)
      : task_(task), tree_(tree), walk_(walk), words_(words) {
    for (std::size_t i = 0; i < walk.steps.size(); ++i) {
      steps_[walk.steps[i].node].push_back(static_cast<int>(i));
    }
    CountParents(tree.root);
  }

  std::vector<view::TreeLine> Take() {
    List(tree_.root, 0);
    return std::move(lines_);
  }

 private:
  void CountParents(NodeId id) {
    if (++parents_[id] > 1) return;
    for (const NodeId child : tree_.node(id).children) CountParents(child);
  }

  // A shared node is listed once, with letters. All other places refer to these letters. An end of
  // the tree needs no line.
  void List(NodeId id, int depth) {
    const PlanNode& node = tree_.node(id);
    if (node.kind == PlanNode::Kind::kGoal) return;
    const bool is_shared = parents_[id] > 1;
    const auto [number, is_new] = numbers_.try_emplace(id, is_shared ? shared_ + 1 : 0);
    if (!is_new) {
      lines_.push_back(
          {.depth = depth, .text = fmt::format("go to {}", LettersOf(number->second))});
      return;
    }
    if (is_shared) ++shared_;
    const std::string label = is_shared ? LettersOf(number->second) + ": " : "";
    if (node.kind == PlanNode::Kind::kAct) {
      ListAction(id, label, depth);
    } else {
      ListBranches(id, label, depth);
    }
  }

  void ListAction(NodeId id, const std::string& label, int depth) {
    const PlanNode& node = tree_.node(id);
    const std::string text = TextOf(task_.actions[node.action.index()]);
    const auto found = words_.find(text);
    lines_.push_back({.depth = depth,
                      .text = label + (found == words_.end() ? text : found->second),
                      .is_action = true,
                      .is_gone = steps_.contains(id),
                      .steps = steps_[id]});
    List(node.children.front(), depth);
  }

  void ListBranches(NodeId id, const std::string& label, int depth) {
    const PlanNode& node = tree_.node(id);
    for (std::size_t child = 0; child < node.children.size(); ++child) {
      const bool is_taken = std::ranges::any_of(walk_.branches, [&](const auto& taken) {
        return taken.node == id && taken.child == child;
      });
      const std::string outcome = OutcomeText(task_, node, child);
      lines_.push_back({.depth = depth,
                        .text = fmt::format("{}if {}", child == 0 ? label : "", outcome),
                        .is_gone = is_taken});
      List(node.children[child], depth + 1);
    }
  }

  const contingent::GroundTask& task_;
  const contingent::PlanTree& tree_;
  const execution::Walk& walk_;
  const std::map<std::string, std::string>& words_;
  std::map<NodeId, std::vector<int>> steps_;
  std::map<NodeId, int> parents_;
  std::map<NodeId, int> numbers_;
  int shared_ = 0;
  std::vector<view::TreeLine> lines_;
};

}  // namespace

std::vector<view::TreeLine> TreeLines(const contingent::GroundTask& task,
                                      const contingent::PlanTree& tree, const execution::Walk& walk,
                                      const std::map<std::string, std::string>& words) {
  return TreeLister(task, tree, walk, words).Take();
}

}  // namespace assay::cli
