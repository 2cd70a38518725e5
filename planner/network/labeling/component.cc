#include "planner/network/labeling/component.h"

#include <numeric>
#include <utility>

namespace assay::network {
namespace {

// Returns `start` and all open nodes that are reachable from it and not taken yet. Marks them as
// taken.
std::vector<int> TakeComponent(int start, const LabelStore& labels, const ArcConsistency& arcs,
                               std::vector<char>& taken) {
  std::vector<int> component = {start};
  taken[start] = 1;
  for (std::size_t i = 0; i < component.size(); ++i) {
    for (const ArcConsistency::Direction& direction : arcs.at(component[i])) {
      const int other = direction.revised;
      if (labels.count(other) <= 1 || std::exchange(taken[other], 1)) continue;
      component.push_back(other);
    }
  }
  return component;
}

}  // namespace

std::vector<std::vector<int>> OpenComponents(std::span<const int> nodes, const LabelStore& labels,
                                             const ArcConsistency& arcs) {
  std::vector<char> taken(labels.node_count(), 0);
  std::vector<std::vector<int>> components;
  for (int node : nodes) {
    if (labels.count(node) <= 1 || taken[node]) continue;
    components.push_back(TakeComponent(node, labels, arcs, taken));
  }
  return components;
}

std::vector<std::vector<int>> OpenComponents(const LabelStore& labels, const ArcConsistency& arcs) {
  std::vector<int> nodes(labels.node_count());
  std::iota(nodes.begin(), nodes.end(), 0);
  return OpenComponents(nodes, labels, arcs);
}

}  // namespace assay::network
