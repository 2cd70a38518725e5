#pragma once

#include <span>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/network/arc_consistency.h"
#include "planner/network/network/counters.h"
#include "planner/network/network/label_store.h"

namespace assay::network {

// The search of TreeSearch::Any for long searches of few nodes with many arcs, with the label sets
// of all nodes side by side in the lanes of vectors. Each label of a node has a row, of what it
// supports at all nodes: the union of the rows of the labels left revises all arcs of the node at
// once, without a branch for any. The states on the way to a node of the tree are copied where
// TreeSearch keeps a trail.
//
// Differences from TreeSearch: nodes are changed in no particular order but that those with one
// label come first; the node to branch on has the fewest labels, squared, per weight.

// Whether label sets have one word, and all rows together a size that caches can hold.
bool FitsLanes(std::span<const int> scope, const LabelStore& labels);

// Any labeling of the scope, which fits, from label sets that are arc consistent; all that an arc
// joins to a node of the scope is in the scope, too, or has one label. `preferred` has for each
// node of the network the label to try first, or TreeSearch::kNoLabel. At kFound each node of the
// scope has one label; else label sets are as before.
Outcome AnyInLanes(std::span<const int> scope, LabelStore& labels, const ArcConsistency& arcs,
                   std::span<const Label> preferred, Counters& counters, Budget& budget);

}  // namespace assay::network
