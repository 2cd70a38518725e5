#include "planner/contingent/plan_tree/tree_text.h"

#include <fmt/format.h>

#include <map>

namespace assay::contingent {
namespace {

class TreeWriter {
 public:
  TreeWriter(const GroundTask& task, const PlanTree& tree, Sharing sharing)
      : task_(task), tree_(tree) {
    CountParents(sharing);
  }

  std::string Write() {
    WriteFrom(tree_.root, 0);
    return std::move(text_);
  }

 private:
  // Numbers the heads of repeats and the sub-plans that are written once for several branches.
  void CountParents(Sharing sharing) {
    std::map<NodeId, int> parents;
    for (const PlanNode& node : tree_.nodes) {
      for (std::size_t i = 0; i < node.children.size(); ++i) {
        const bool is_goal = tree_.node(node.children[i]).kind == PlanNode::Kind::kGoal;
        if (is_goal || (sharing == Sharing::kUnfolded && !node.Repeats(i))) continue;
        if (++parents[node.children[i]] > 1 || node.Repeats(i)) numbers_[node.children[i]] = 0;
      }
    }
  }

  void Line(int indent, const std::string& words) {
    text_ += fmt::format("{:{}}{}\n", "", 2 * indent, words);
  }

  // Writes chains of nodes with one child in a loop, so that long plans do not nest deeply.
  void WriteFrom(NodeId id, int indent) {
    while (true) {
      const PlanNode& node = tree_.node(id);
      std::string number;
      if (const auto entry = numbers_.find(id); entry != numbers_.end()) {
        if (entry->second > 0 && is_written_[id]) return Line(indent, GoTo(id));
        if (entry->second == 0) entry->second = ++last_number_;
        is_written_[id] = true;
        number = fmt::format("{}:", entry->second);
      }
      if (node.kind == PlanNode::Kind::kGoal) return;
      if (node.kind != PlanNode::Kind::kAct) return WriteBranches(node, indent, number);
      if (!number.empty()) number += ' ';
      Line(indent, number + TextOf(task_.actions[node.action.index()]));
      if (node.Repeats(0)) return Line(indent, GoTo(node.children.front()));
      id = node.children.front();
    }
  }

  void WriteBranches(const PlanNode& node, int indent, const std::string& number) {
    if (!number.empty()) Line(indent, number);
    for (std::size_t i = 0; i < node.children.size(); ++i) {
      Line(indent, "branch " + OutcomeText(task_, node, i));
      if (node.Repeats(i)) {
        Line(indent + 1, GoTo(node.children[i]));
      } else {
        WriteFrom(node.children[i], indent + 1);
      }
    }
  }

  std::string GoTo(NodeId id) const { return fmt::format("go to {}", numbers_.at(id)); }

  const GroundTask& task_;
  const PlanTree& tree_;
  std::map<NodeId, int> numbers_;  // 0 until a number is given
  std::map<NodeId, bool> is_written_;
  int last_number_ = 0;
  std::string text_;
};

}  // namespace

std::string OutcomeText(const GroundTask& task, const PlanNode& node, std::size_t child) {
  if (node.kind == PlanNode::Kind::kValue) return task.atoms[node.values[child].index()];
  const Formula& formula = task.formulas[node.formula.index()];
  if (child == 0) return TextOf(task, formula);
  if (formula.bound || formula.literals.size() > 1) return "!(" + TextOf(task, formula) + ")";
  const GroundLiteral& literal = formula.literals.front();
  return TextOf(task, GroundLiteral{literal.atom, !literal.is_positive});
}

std::string TextOf(const GroundTask& task, const PlanTree& tree, Sharing sharing) {
  return TreeWriter(task, tree, sharing).Write();
}

}  // namespace assay::contingent
