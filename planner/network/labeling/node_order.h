#pragma once

#include <cstdint>
#include <vector>

#include "planner/network/constraint_network/arc_consistency.h"
#include "planner/network/constraint_network/label_store.h"

namespace assay::network {

// The rule by which a search chooses the node to branch on.
enum class NodeOrder {
  // The open node with the fewest labels per weight. It changes as the search learns.
  // (Last-conflict reasoning, which returns to the node whose last choice failed, was tried. It
  // made the search trees of proofs larger.)
  kConflictWeighted,
  // The first open node in the given order.
  kGiven,
};

// The open nodes of a search, which are those with more than one label, and the weights of the arcs
// between them (dom/wdeg: Boussemart, Hemery, Lecoutre and Sais 2004). A node is closed when it is
// found to have one label. Nodes are reopened in the reverse order of closing, so each closing or
// reopening only updates the sums of weights.
class OpenNodes {
 public:
  // Nodes outside `scope` count as closed. Only this search may change the label sets and the
  // weights of the arcs.
  OpenNodes(std::vector<int> scope, const LabelStore& labels, const ArcConsistency& arcs);

  // Closes the nodes that have one label.
  void Update();
  int count() const { return count_; }
  void Reopen(int count);  // restores the state in which count() had this value

  // Increases the weight of the wipe-out's arc by one. Call it for each wipe-out.
  void Blame(const ArcConsistency::WipeOut& wipe_out);

  // First and Heaviest return -1 if no node is open.
  int First() const;     // the first open node of the scope
  int Heaviest() const;  // the node with the fewest labels per weight

 private:
  bool IsOpen(int node) const { return places_[node] < count_; }
  void Swap(int place, int other);

  const LabelStore& labels_;
  const ArcConsistency& arcs_;
  std::vector<int> scope_;
  std::vector<int> nodes_;   // the nodes of the scope, open nodes first
  int count_ = 0;            // the number of open nodes
  std::vector<int> places_;  // indexed by node: its place in nodes_
  // Indexed by node: the total weight of its arcs to open nodes.
  std::vector<std::int64_t> weights_;
};

}  // namespace assay::network
