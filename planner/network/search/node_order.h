#pragma once

#include <cstdint>
#include <vector>

#include "planner/network/network/arc_consistency.h"
#include "planner/network/network/label_store.h"

namespace assay::network {

// How a search chooses the node to branch on.
enum class NodeOrder {
  // The heaviest open node. Changes as the search learns. (Going back to the node whose last choice
  // failed, as last-conflict reasoning does, made the search trees of the proofs tried larger.)
  kConflictWeighted,
  // The first open node.
  kGiven,
};

// The open nodes of a search, which are those with more than one label, and the weights of their
// arcs to each other (dom/wdeg: Boussemart, Hemery, Lecoutre and Sais 2004). Nodes are closed as
// they are found to have one label, and opened again in reverse, so that weights are kept up to
// date without being summed anew.
class OpenNodes {
 public:
  // All other nodes are closed. The label sets and the weights of the arcs change by this search
  // alone.
  OpenNodes(std::vector<int> scope, const LabelStore& labels, const ArcConsistency& arcs);

  // Closes what has one label by now.
  void Update();
  int count() const { return count_; }
  void Reopen(int count);  // as it was when count() was this

  // To be told of each wipe-out, whose arc becomes heavier by one.
  void Blame(const ArcConsistency::WipeOut& wipe_out);

  // Both are -1 if no node is open.
  int First() const;     // in the order of the scope
  int Heaviest() const;  // the fewest labels per weight

 private:
  bool IsOpen(int node) const { return places_[node] < count_; }
  void Swap(int place, int other);

  const LabelStore& labels_;
  const ArcConsistency& arcs_;
  std::vector<int> scope_;
  std::vector<int> nodes_;             // the scope; the open ones first
  int count_ = 0;                      // of them
  std::vector<int> places_;            // by node: in nodes_
  std::vector<std::int64_t> weights_;  // by node: of the arcs to open nodes
};

}  // namespace assay::network
