#pragma once

#include <span>

#include "planner/network/arc_consistency.h"
#include "planner/network/label_store.h"

namespace assay::network {

// How a search chooses the node to branch on.
enum class NodeOrder {
  // The heaviest open node. Changes as the search learns. (Going back to the node whose last choice
  // failed, as last-conflict reasoning does, made the search trees of the proofs tried larger.)
  kConflictWeighted,
  // The first open node.
  kGiven,
};

// A node is open while it has more than one label. Both give -1 if none of `nodes` is.
int FirstOpen(std::span<const int> nodes, const LabelStore& labels);

// The open node with the fewest labels per weight of its arcs to other open nodes (dom/wdeg:
// Boussemart, Hemery, Lecoutre and Sais 2004), the first of several.
int HeaviestOpen(std::span<const int> nodes, const LabelStore& labels, const ArcConsistency& arcs);

}  // namespace assay::network
