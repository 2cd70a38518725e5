#include "planner/network/node_order.h"

namespace assay::network {
namespace {

double OpenWeight(int node, const LabelStore& labels, const ArcConsistency& arcs) {
  double weight = 0;
  for (const ArcConsistency::Direction& direction : arcs.at(node)) {
    if (labels.count(direction.revised) > 1) weight += arcs.weight(direction.arc);
  }
  return weight;
}

}  // namespace

int FirstOpen(std::span<const int> nodes, const LabelStore& labels) {
  for (int node : nodes) {
    if (labels.count(node) > 1) return node;
  }
  return -1;
}

int HeaviestOpen(std::span<const int> nodes, const LabelStore& labels, const ArcConsistency& arcs) {
  int best = -1;
  double best_count = 0, best_weight = 0;
  for (int node : nodes) {
    const double count = labels.count(node);
    if (count <= 1) continue;
    const double weight = OpenWeight(node, labels, arcs);
    if (best < 0 || count * best_weight < best_count * weight) {
      best = node;
      best_count = count;
      best_weight = weight;
    }
  }
  return best;
}

}  // namespace assay::network
