#pragma once

#include <span>
#include <vector>

#include "planner/network/constraint_network/arc_consistency.h"
#include "planner/network/constraint_network/label_store.h"
#include "planner/network/simd_rows/lanes.h"

namespace assay::network {

inline constexpr int kNoLane = -1;

// Returns, for each node of the network, its place in the scope, or kNoLane. This place is also the
// index of the node's element (a Lane) in every SIMD row.
std::vector<int> LanesOf(std::span<const int> scope, int node_count);

// The SIMD rows of all labels of the nodes of a scope. A row has one element for each node of the
// scope: the labels there that the row's label supports. A node that no arc joins to the label's
// node is supported entirely. At its own node a label supports only itself.
template <class Lane>
class LaneRows {
 public:
  // `lane_of` is the result of LanesOf. Each label set is one word and not wider than an element.
  LaneRows(std::span<const int> scope, std::span<const int> lane_of, const LabelStore& labels,
           const ArcConsistency& arcs);

  int blocks() const { return blocks_; }  // blocks in a row
  const Rows<Lane>& of(int lane) const { return nodes_[lane].rows; }
  // Returns the greatest number of labels of this node that one label of another node forbids. If
  // more labels are left, no label of another node can be removed.
  int most_unsupporting(int lane) const { return nodes_[lane].most_unsupporting; }
  int degree(int lane) const { return nodes_[lane].degree; }  // number of arcs within the scope

 private:
  struct Node {
    Rows<Lane> rows;
    int most_unsupporting = 0;
    int degree = 0;
  };
  void AddRows(int lane, int node, std::span<const int> lane_of, const ArcConsistency& arcs,
               Block<Lane>* first);

  int blocks_;
  std::vector<Block<Lane>> blocks_of_rows_;
  std::vector<Node> nodes_;  // indexed by node of the scope
};

}  // namespace assay::network
