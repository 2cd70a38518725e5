#include "planner/contingent/search/node_table.h"

#include <utility>

namespace assay::contingent {
namespace {

std::uint64_t HashOfNode(const PlanNode& node) {
  std::uint64_t hash = static_cast<std::uint64_t>(node.kind);
  for (const int index : {node.action.index(), node.formula.index(), node.function.index()}) {
    hash = MixedHash(hash, static_cast<std::uint64_t>(index));
  }
  for (const NodeId child : node.children) {
    hash = MixedHash(hash, static_cast<std::uint64_t>(child.index()));
  }
  return hash;
}

}  // namespace

NodeId NodeTable::Intern(PlanNode node) {
  const std::uint64_t hash = HashOfNode(node);
  const int found = ids_.Find(hash, [&](int index) { return nodes_[index] == node; });
  if (found >= 0) return NodeId(found);
  const NodeId id = Append(std::move(node));
  ids_.Insert(hash, id.index());
  return id;
}

NodeId NodeTable::Append(PlanNode node) {
  nodes_.push_back(std::move(node));
  return NodeId(nodes_.size() - 1);
}

}  // namespace assay::contingent
