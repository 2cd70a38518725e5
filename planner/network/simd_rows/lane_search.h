#pragma once

#include <span>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/constraint_network/arc_consistency.h"
#include "planner/network/constraint_network/counters.h"
#include "planner/network/constraint_network/label_store.h"

namespace assay::network {

// A search like TreeSearch::Any for long searches over few nodes with many arcs. The label sets of
// all nodes are the elements of one SIMD row. Each label of a node has a row, too, with what it
// supports at all nodes. The union of the rows of a node's remaining labels revises all arcs of the
// node at once, without branches. Each decision copies the row of label sets, where TreeSearch
// keeps a trail.
//
// There are two differences from TreeSearch. Changed nodes are propagated in no particular order,
// except that nodes with one label come first. The search branches on the node for which
// (number of labels)^2 / weight is least. The weight of a node is the sum of the weights of its
// arcs to open nodes.

// Returns true if every label set fits into one word and all rows together fit into the caches.
bool FitsLanes(std::span<const int> scope, const LabelStore& labels);

// Searches with SIMD instructions for any labeling of the scope, which must satisfy FitsLanes. The
// label sets must be arc consistent. A node that an arc joins to the scope must be in the scope or
// have one label. `preferred` has, for each node of the network, the label to try first or
// TreeSearch::kNoLabel. At kFound each node of the scope has one label; otherwise the label sets
// are unchanged.
Outcome AnyInLanes(std::span<const int> scope, LabelStore& labels, const ArcConsistency& arcs,
                   std::span<const Label> preferred, Counters& counters, Budget& budget);

}  // namespace assay::network
