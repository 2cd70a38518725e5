#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace assay::algebra {

// Marks of the nodes that one walk over a pool has met, and the index that the walk has given to
// each of them. The memory is reused by the next walk, so that a walk takes no time for nodes that
// it does not meet.
class NodeMarks {
 public:
  // Begins a walk, for which no node has been met.
  void Begin(std::size_t node_count) {
    met_by_.resize(node_count, walk_);
    places_.resize(node_count);
    if (++walk_ == 0) {
      std::ranges::fill(met_by_, 0);
      walk_ = 1;
    }
  }

  // Returns true if the walk meets the node for the first time.
  bool Meet(int index) { return std::exchange(met_by_[index], walk_) != walk_; }

  // The index that the walk has given to a node.
  int& place(int index) { return places_[index]; }

 private:
  std::vector<std::uint32_t> met_by_;  // the last walk that met the node
  std::vector<int> places_;
  std::uint32_t walk_ = 0;
};

}  // namespace assay::algebra
