#pragma once

#include <compare>
#include <vector>

#include "planner/network/constraint_network/label_store.h"

namespace assay::network {

// One label for each node of a network.
struct Labeling {
  std::vector<Label> labels;  // indexed by node index

  Label operator[](NodeId node) const { return labels[node.index()]; }
  auto operator<=>(const Labeling&) const = default;
};

}  // namespace assay::network
