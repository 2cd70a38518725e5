#pragma once

#include <span>
#include <vector>

#include "planner/network/lanes/lane_rows.h"
#include "planner/network/network/arc_consistency.h"

namespace assay::network {

// What OpenNodes is to label sets, for lanes: the weights of the arcs are a matrix, of which rows
// are added and subtracted.
class OpenLanes {
 public:
  OpenLanes(std::span<const int> scope, std::span<const int> lane_of, const ArcConsistency& arcs);

  // Closes what has one label by now.
  template <class Lane>
  void Update(const Lane* lanes);
  int count() const { return count_; }
  void Reopen(int count);  // as it was when count() was this
  void Blame(int changed, int revised);

  // The fewest labels, squared, per weight; -1 if no lane is open.
  template <class Lane>
  int Heaviest(const Lane* lanes) const;

 private:
  const int* ArcsOf(int lane) const { return &arc_weights_[lane * places_.size()]; }
  bool IsOpen(int lane) const { return places_[lane] < count_; }
  void Swap(int place, int other);

  std::vector<int> arc_weights_;  // lanes x lanes
  std::vector<int> weights_;      // by lane: of the arcs to open lanes
  std::vector<int> order_;        // all lanes; the open ones first
  std::vector<int> places_;       // by lane: in order_
  int count_ = 0;
};

}  // namespace assay::network
