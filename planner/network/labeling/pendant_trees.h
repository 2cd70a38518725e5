#pragma once

#include <span>
#include <vector>

#include "planner/network/constraint_network/arc_consistency.h"
#include "planner/network/constraint_network/label_store.h"

namespace assay::network {

// A node of a pendant tree. An arc to its parent joins it to the rest of its component.
struct HangingNode {
  static constexpr int kNoParent = -1;  // the parent of the root, if the whole component is a tree

  int node;
  int parent;
  const Word* supported;  // the labels here that each label of the parent supports
};

struct PendantTrees {
  std::vector<int> core;  // the component without its pendant trees, in the component's order
  std::vector<HangingNode> hanging;  // children before parents
};

// Returns the pendant trees of a component, which hang from its cycles. If the label sets are arc
// consistent, pendant trees need no search: for any label of the parent its children have a label
// (Freuder 1982).
PendantTrees PendantTreesOf(std::span<const int> component, const LabelStore& labels,
                            const ArcConsistency& arcs);

}  // namespace assay::network
