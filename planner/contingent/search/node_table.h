#pragma once

#include <vector>

#include "planner/algebra/expression/intern_table.h"
#include "planner/contingent/tree/plan_tree.h"

namespace assay::contingent {

// The nodes of a tree in the making: equal sub-plans are one node.
class NodeTable {
 public:
  NodeId Intern(PlanNode node);
  // A node of its own, whatever others there are; its children may come later.
  NodeId Append(PlanNode node);
  PlanNode& node(NodeId id) { return nodes_[id.index()]; }
  const std::vector<PlanNode>& nodes() const { return nodes_; }

 private:
  std::vector<PlanNode> nodes_;
  algebra::InternTable ids_;
};

}  // namespace assay::contingent
