#pragma once

#include <span>
#include <vector>

#include "planner/network/constraint_network/arc_consistency.h"
#include "planner/network/constraint_network/label_store.h"

namespace assay::network {

// Returns the connected components of the open nodes (those with more than one label) among
// `nodes`. Only arcs between open nodes count. If the label sets are arc consistent, the components
// are independent of each other. `nodes` must contain all open nodes that an arc joins to one of
// `nodes`. Components are in the order of their first nodes.
std::vector<std::vector<int>> OpenComponents(std::span<const int> nodes, const LabelStore& labels,
                                             const ArcConsistency& arcs);

std::vector<std::vector<int>> OpenComponents(const LabelStore& labels, const ArcConsistency& arcs);

}  // namespace assay::network
