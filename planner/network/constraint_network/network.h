#pragma once

#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/constraint_network/arc_consistency.h"
#include "planner/network/constraint_network/counters.h"
#include "planner/network/constraint_network/label_set.h"
#include "planner/network/constraint_network/label_store.h"
#include "planner/network/constraint_network/labeling.h"
#include "planner/network/constraint_network/relation.h"
#include "planner/network/labeling/pendant_trees.h"

namespace assay::network {

// An undirected constraint between two nodes. Rows of the relation are labels of the first node,
// columns are labels of the second. Both may be the same node, and two nodes may have several arcs.
struct Arc {
  NodeId a, b;
  std::shared_ptr<const Relation> relation;
};

// A binary constraint network for constraint posting. Each posted constraint gets a complete
// answer: whether a labeling remains (Spar: Hutchinson and Kak 1990, "Constraints at the Geometric
// Level of Planning").
//
// Differences from the paper: The last labeling is kept as a witness. If a new constraint violates
// it, another label for one node is tried first, so that most posts need neither propagation nor
// search. The search maintains arc consistency. Label sets are made arc consistent on demand.
class Network {
 public:
  // ---- Constraints with a consistency check -----------------------------------------------
  // kFound: a labeling remains, and the constraint holds from then on. kNone: it is proved that no
  // labeling would remain. kBudget: not decided. If the answer is kNone or kBudget, the label sets,
  // the arcs and the witness (the last labeling) are as before. A search takes one unit of the
  // budget for each node of the search tree. Without a budget it continues until the answer is
  // known.

  // The paper's member(Variable, Labels), for a variable that is already a node.
  Outcome Restrict(NodeId node, const LabelSet& allowed);
  Outcome Restrict(NodeId node, const LabelSet& allowed, Budget& budget);

  Outcome Post(NodeId a, NodeId b, std::shared_ptr<const Relation> relation);
  Outcome Post(NodeId a, NodeId b, std::shared_ptr<const Relation> relation, Budget& budget);

  // ---- Constraints without a check --------------------------------------------------------
  // AddNode states the variable's initial constraint. It cannot violate any other constraint.
  NodeId AddNode(const LabelSet& labels);
  void Narrow(NodeId node, const LabelSet& allowed);
  void AddArc(NodeId a, NodeId b, std::shared_ptr<const Relation> relation);

  // Decides whether the network has a labeling. After kFound the witness is known. After kFound and
  // kBudget the label sets are arc consistent; after kNone they are unchanged.
  Outcome Decide();
  Outcome Decide(Budget& budget);

  // ---- Undo -------------------------------------------------------------------------------
  struct Mark {
    int nodes, arcs;
    LabelStore::Mark labels;
    bool propagated, owed;
  };
  Mark Save();
  // Undoes everything since the mark. The mark must have been set on this network and not undone
  // before.
  void Undo(const Mark& mark);

  // ---- What is known ----------------------------------------------------------------------
  int node_count() const { return labels_.node_count(); }
  // Returns the labels that are still possible by the constraints so far and by arc consistency as
  // of the last check.
  LabelSet labels(NodeId node) const;
  std::span<const Arc> arcs() const { return arcs_; }
  // Returns a labeling of the present network, or null if none is known.
  const Labeling* witness() const { return witness_holds_ ? &witness_ : nullptr; }
  bool Satisfies(const Labeling& labeling) const;
  const Counters& counters() const { return counters_; }

  // Forgets what earlier searches have learned for the variable order.
  void ForgetWeights() { consistency_.ForgetWeights(); }

  // label_store and arc_consistency are for the searches of this library.
  const LabelStore& label_store() const { return labels_; }
  const ArcConsistency& arc_consistency() const { return consistency_; }

 private:
  void CheckNode(NodeId node) const;
  template <class Constrain>
  Outcome Try(std::initializer_list<NodeId> ends, const Constrain& constrain, Budget& budget);
  bool HasEmptyNode() const;
  bool Propagate() const;
  Outcome Search(Budget& budget);
  Outcome FindWitness(Budget& budget);
  Outcome LabelComponent(std::span<const int> component, Labeling& found, Budget& budget);
  Outcome SearchCore(const std::vector<int>& core, Budget& budget);
  void LabelPendantTrees(const PendantTrees& pendant_trees, Labeling& found) const;
  bool HoldsWithin(std::span<const int> component) const;
  bool Mend(NodeId node);
  void NarrowToLoop(NodeId node, const Relation& relation);

  // These are mutable because arc consistency only makes known facts explicit. A propagation that
  // is still due is done when a caller asks for its result.
  mutable LabelStore labels_;
  mutable ArcConsistency consistency_;
  mutable Counters counters_;
  std::vector<Arc> arcs_;
  // Changes that are not propagated are in the queue of consistency_. Their propagation is due
  // (owed_) after a check has found a labeling.
  mutable bool propagated_ = true;
  bool owed_ = false;

  // The last labeling found. If it does not hold, it is still the best guess.
  Labeling witness_;
  bool witness_holds_ = true;
};

}  // namespace assay::network
