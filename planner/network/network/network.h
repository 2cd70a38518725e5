#pragma once

#include <initializer_list>
#include <memory>
#include <span>
#include <vector>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/network/arc_consistency.h"
#include "planner/network/network/counters.h"
#include "planner/network/network/label_set.h"
#include "planner/network/network/label_store.h"
#include "planner/network/network/labeling.h"
#include "planner/network/network/relation.h"
#include "planner/network/search/fringe.h"

namespace assay::network {

// An undirected constraint between two nodes: the first takes the relation's rows, the second its
// columns. The two may be the same node, and two nodes may have several arcs.
struct Arc {
  NodeId a, b;
  std::shared_ptr<const Relation> relation;
};

// A binary constraint network that constraints are posted to one by one, each with a complete
// answer whether a labeling is left (Spar: Hutchinson and Kak 1990, "Constraints at the Geometric
// Level of Planning"). Differences from the paper: the last labeling is kept, and where it does not
// hold any more first mended in one node, so that most posts need neither propagation nor search;
// search maintains arc consistency; label sets are made arc consistent when they are asked for.
class Network {
 public:
  // ---- Constraints with a consistency check -----------------------------------------------
  // kFound: a labeling is left, the constraint holds from now on. kNone: proved that none would be
  // left. kBudget: not decided. After kNone and kBudget label sets, arcs and the witness are as
  // before. Searches take one unit of the budget for each node of the search tree; without a
  // budget they go on to an answer.

  // The paper's member(Variable, Labels), for a variable that is a node already.
  Outcome Restrict(NodeId node, const LabelSet& allowed);
  Outcome Restrict(NodeId node, const LabelSet& allowed, Budget& budget);

  Outcome Post(NodeId a, NodeId b, std::shared_ptr<const Relation> relation);
  Outcome Post(NodeId a, NodeId b, std::shared_ptr<const Relation> relation, Budget& budget);

  // ---- Constraints without a check --------------------------------------------------------
  // The variable's initial constraint: nothing else can be violated yet.
  NodeId AddNode(const LabelSet& labels);
  void Narrow(NodeId node, const LabelSet& allowed);
  void AddArc(NodeId a, NodeId b, std::shared_ptr<const Relation> relation);

  // Whether the network has a labeling. Afterwards, unless the answer is kNone, the label sets are
  // arc consistent and, at kFound, the witness is known; at kNone the label sets are as before.
  Outcome Decide();
  Outcome Decide(Budget& budget);

  // ---- Undo -------------------------------------------------------------------------------
  struct Mark {
    int nodes, arcs;
    LabelStore::Mark labels;
    bool propagated, owed;
  };
  Mark Save();
  // Takes back everything since the mark, which was set on this network and not undone before.
  void Undo(const Mark& mark);

  // ---- What is known ----------------------------------------------------------------------
  int node_count() const { return labels_.node_count(); }
  // The labels still possible, by the constraints so far and by arc consistency as of the last
  // check.
  LabelSet labels(NodeId node) const;
  std::span<const Arc> arcs() const { return arcs_; }
  // A labeling of the present network; null if none is known.
  const Labeling* witness() const { return witness_holds_ ? &witness_ : nullptr; }
  bool Satisfies(const Labeling& labeling) const;
  const Counters& counters() const { return counters_; }

  // Forgets what earlier searches have learned for the variable order.
  void ForgetWeights() { consistency_.ForgetWeights(); }

  // For the searches of this library.
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
  void LabelFringe(const Fringe& fringe, Labeling& found) const;
  bool HoldsWithin(std::span<const int> component) const;
  bool Mend(NodeId node);
  void NarrowToLoop(NodeId node, const Relation& relation);

  // Mutable, because arc consistency says nothing new: what is owed is made up for when somebody
  // asks for it.
  mutable LabelStore labels_;
  mutable ArcConsistency consistency_;
  mutable Counters counters_;
  std::vector<Arc> arcs_;
  // What is not propagated is in the queue of consistency_. It is owed once a check has found that
  // there is a labeling.
  mutable bool propagated_ = true;
  bool owed_ = false;

  // The last labeling found. When it does not hold any more it is still the best guess.
  Labeling witness_;
  bool witness_holds_ = true;
};

}  // namespace assay::network
