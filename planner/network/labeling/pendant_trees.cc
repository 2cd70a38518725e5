#include "planner/network/labeling/pendant_trees.h"

#include <algorithm>

namespace assay::network {
namespace {

// Removes nodes with one open arc repeatedly.
class Peeling {
 public:
  Peeling(std::span<const int> component, const LabelStore& labels, const ArcConsistency& arcs)
      : labels_(labels), arcs_(arcs), degrees_(labels.node_count(), kOutside) {
    for (int node : component) degrees_[node] = OpenDegree(node);
  }

  PendantTrees Peel(std::span<const int> component) {
    for (int node : component) {
      if (degrees_[node] <= 1) peeled_.push_back(node);
    }
    for (std::size_t i = 0; i < peeled_.size(); ++i) Take(peeled_[i]);
    for (int node : component) {
      if (degrees_[node] > 1) pendant_trees_.core.push_back(node);
    }
    return std::move(pendant_trees_);
  }

 private:
  static constexpr int kOutside = -1;

  int OpenDegree(int node) const {
    int degree = 0;
    for (const ArcConsistency::Direction& direction : arcs_.at(node)) {
      if (labels_.count(direction.revised) > 1) ++degree;
    }
    return degree;
  }

  void Take(int node) {
    HangingNode hanging{.node = node, .parent = HangingNode::kNoParent, .supported = nullptr};
    degrees_[node] = kOutside;
    for (const ArcConsistency::Direction& direction : arcs_.at(node)) {
      int& degree = degrees_[direction.revised];
      if (degree == kOutside) continue;
      hanging.parent = direction.revised;
      hanging.supported = direction.supports;
      if (--degree == 1) peeled_.push_back(direction.revised);
    }
    pendant_trees_.hanging.push_back(hanging);
  }

  const LabelStore& labels_;
  const ArcConsistency& arcs_;
  std::vector<int> degrees_;  // indexed by node: open arcs to nodes that are not removed
  std::vector<int> peeled_;
  PendantTrees pendant_trees_;
};

}  // namespace

PendantTrees PendantTreesOf(std::span<const int> component, const LabelStore& labels,
                            const ArcConsistency& arcs) {
  return Peeling(component, labels, arcs).Peel(component);
}

}  // namespace assay::network
