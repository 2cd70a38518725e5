#pragma once

#include <bit>
#include <vector>

#include "planner/network/constraint_network/label_set.h"

namespace assay::network {

// Nodes in lists by their number of labels, from 1 to kWordBits. Finding a node with the fewest
// labels and moving a node between lists take constant time.
class NodesByCount {
 public:
  explicit NodesByCount(int node_count) : links_(node_count) {
    for (int& first : first_) first = kNone;
  }

  bool empty() const { return counts_ == 0; }
  // Returns, of the nodes with the fewest labels, the one added last. There must be a node.
  int First() const { return first_[std::countr_zero(counts_)]; }

  void Add(int node, int count) {
    int& first = first_[count - 1];
    links_[node] = {.count = count, .previous = kNone, .next = first};
    if (first != kNone) links_[first].previous = node;
    first = node;
    counts_ |= BitOf(count - 1);
  }

  void Remove(int node) {
    const Links& links = links_[node];
    if (links.next != kNone) links_[links.next].previous = links.previous;
    if (links.previous != kNone) {
      links_[links.previous].next = links.next;
      return;
    }
    first_[links.count - 1] = links.next;
    if (links.next == kNone) counts_ &= ~BitOf(links.count - 1);
  }

 private:
  static constexpr int kNone = -1;
  struct Links {
    int count, previous, next;
  };

  std::vector<Links> links_;  // indexed by node
  int first_[kWordBits];      // indexed by count - 1
  Word counts_ = 0;           // bit i is set if the list of count i + 1 is not empty
};

}  // namespace assay::network
