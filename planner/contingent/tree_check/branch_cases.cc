#include "planner/contingent/tree_check/branch_cases.h"

#include "planner/contingent/plan_tree/tree_text.h"

namespace assay::contingent {

BranchCases::BranchCases(const GroundTask& task, const PlanNode& node) : task_(task), node_(node) {
  if (node.kind == PlanNode::Kind::kWhether) {
    cases_ = {task.formulas[node.formula.index()].literals};
  } else {
    for (const AtomId value : node.values) cases_.push_back({{value, true}});
  }
}

void BranchCases::Split(WorldProgression& progression, Worlds& worlds) const {
  for (const std::vector<GroundLiteral>& literals : cases_) {
    for (const GroundLiteral& literal : literals) progression.SplitBy(literal.atom, worlds);
  }
}

int BranchCases::ChildFor(const WorldProgression& progression, const World& world) const {
  if (node_.kind == PlanNode::Kind::kWhether) {
    return progression.IsTrue(task_.formulas[node_.formula.index()], world) ? 0 : 1;
  }
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    if (progression.IsTrue(cases_[i].front(), world)) return static_cast<int>(i);
  }
  return -1;
}

std::string BranchCases::Question() const {
  return node_.kind == PlanNode::Kind::kValue
             ? task_.functions[node_.function.index()].text
             : TextOf(task_, task_.formulas[node_.formula.index()]);
}

}  // namespace assay::contingent
