#pragma once

#include <span>
#include <vector>

#include "planner/network/network/arc_consistency.h"
#include "planner/network/network/label_store.h"

namespace assay::network {

// A node of a tree that hangs from the rest of its component by the arc to its parent.
struct HangingNode {
  static constexpr int kNoParent = -1;  // the root, if the whole component is a tree

  int node;
  int parent;
  const Word* supported;  // by each label of the parent
};

struct Fringe {
  std::vector<int> core;             // what is left without the trees, in the component's order
  std::vector<HangingNode> hanging;  // children before parents
};

// The trees that hang from a component's cycles. In arc consistent label sets they need no search:
// whatever label the parent takes, its children have one (Freuder 1982).
Fringe FringeOf(std::span<const int> component, const LabelStore& labels,
                const ArcConsistency& arcs);

}  // namespace assay::network
