#pragma once

#include <span>
#include <vector>

#include "planner/network/constraint_network/arc_consistency.h"
#include "planner/network/simd_rows/lane_rows.h"

namespace assay::network {

// The open nodes of a LaneSearch with the weights of their arcs. It corresponds to OpenNodes. The
// weights of the arcs are a matrix, whose rows are added and subtracted.
class OpenLanes {
 public:
  OpenLanes(std::span<const int> scope, std::span<const int> lane_of, const ArcConsistency& arcs);

  // Closes the nodes that have one label.
  template <class Lane>
  void Update(const Lane* lanes);
  int count() const { return count_; }
  void Reopen(int count);  // restores the state in which count() had this value
  void Blame(int changed, int revised);

  // Returns the open node for which (number of labels)^2 / weight is least, or -1 if no node is
  // open.
  template <class Lane>
  int Heaviest(const Lane* lanes) const;

 private:
  const int* ArcsOf(int lane) const { return &arc_weights_[lane * places_.size()]; }
  bool IsOpen(int lane) const { return places_[lane] < count_; }
  void Swap(int place, int other);

  std::vector<int> arc_weights_;  // nodes x nodes
  std::vector<int> weights_;      // indexed by node: the total weight of its arcs to open nodes
  std::vector<int> order_;        // all nodes; the open ones come first
  std::vector<int> places_;       // indexed by node: its place in order_
  int count_ = 0;
};

}  // namespace assay::network
