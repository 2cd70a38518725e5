#pragma once

#include <span>
#include <vector>

#include "planner/network/lanes/lanes.h"
#include "planner/network/network/arc_consistency.h"
#include "planner/network/network/label_store.h"

namespace assay::network {

inline constexpr int kNoLane = -1;

// By node of the network: its place in the scope, which is its lane, or kNoLane.
std::vector<int> LanesOf(std::span<const int> scope, int node_count);

// The rows of all labels that the nodes of a scope have. What an arc does not reach is supported
// by every label, and in its own lane a label supports itself.
template <class Lane>
class LaneRows {
 public:
  // `lane_of` as LanesOf gives it. Label sets have one word, no wider than a lane.
  LaneRows(std::span<const int> scope, std::span<const int> lane_of, const LabelStore& labels,
           const ArcConsistency& arcs);

  int blocks() const { return blocks_; }  // of a row
  const Rows<Lane>& of(int lane) const { return nodes_[lane].rows; }
  // The most labels of this node that a label of another forbids: with more of them left, nothing
  // can be taken from the others.
  int most_unsupporting(int lane) const { return nodes_[lane].most_unsupporting; }
  int degree(int lane) const { return nodes_[lane].degree; }  // arcs within the scope

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
  std::vector<Node> nodes_;  // by lane
};

}  // namespace assay::network
