#pragma once

#include <vector>

#include "planner/base/intern_table.h"
#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::contingent {

// The nodes of a tree under construction. Equal sub-plans are one node.
class NodeTable {
 public:
  NodeId Intern(PlanNode node);
  // Adds a node that is not shared with equal nodes. Its children may be added later.
  NodeId Append(PlanNode node);
  PlanNode& node(NodeId id) { return nodes_[id.index()]; }
  const std::vector<PlanNode>& nodes() const { return nodes_; }

 private:
  std::vector<PlanNode> nodes_;
  InternTable ids_;
};

}  // namespace assay::contingent
