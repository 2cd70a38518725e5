#pragma once

#include <span>
#include <vector>

#include "planner/network/network/arc_consistency.h"
#include "planner/network/network/label_store.h"

namespace assay::network {

// The connected components of the open nodes (those with more than one label) among `nodes`, by
// arcs between open nodes: in arc consistent label sets the components do not depend on each
// other. All open nodes that an arc joins to one of `nodes` are among them, too. Components come
// in the order of their first nodes.
std::vector<std::vector<int>> OpenComponents(std::span<const int> nodes, const LabelStore& labels,
                                             const ArcConsistency& arcs);

std::vector<std::vector<int>> OpenComponents(const LabelStore& labels, const ArcConsistency& arcs);

}  // namespace assay::network
