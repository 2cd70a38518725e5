#pragma once

#include <cstdint>
#include <vector>

#include "planner/network/counters.h"
#include "planner/network/label_store.h"
#include "planner/network/relation.h"

namespace assay::network {

// Arc consistency over the label sets of a store: every label keeps a support on every arc.
// AC-3 with a queue of nodes (Mackworth 1977; McGregor 1979), smallest label set first, label sets
// and supports as words of bits (Lecoutre and Vion 2008) and, in sets of several words, the word
// of the last support remembered (residual supports, Lecoutre and Hemery 2007).
//
// Each wipe-out adds to the weight of the arc at which it happened, for the variable order of
// searches (Boussemart, Hemery, Lecoutre and Sais 2004).
class ArcConsistency {
 public:
  // One direction of an arc, kept at the node whose change calls for the revision.
  struct Direction {
    int revised;            // the node at the other end
    int arc;                // the index that AddArc was given
    int most_unsupporting;  // labels of the changed node that one revised label forbids, at most
    int residues;           // index of the first label's residual support
    const Word* supports;   // of each label of the revised node
    const Word* supported;  // by each label of the changed node
  };

  // Arcs and nodes come and go last in, first out. Relations must outlive their arcs. The two
  // nodes of an arc differ: an arc from a node to itself is a restriction of its labels.
  void AddNode();
  void RemoveLastNode();
  void AddArc(int arc, int a, int b, const Relation& relation);
  void RemoveLastArc(int a, int b);

  const std::vector<Direction>& at(int node) const { return at_[node]; }
  double weight(int arc) const { return weights_[arc]; }
  void ForgetWeights();  // all equal, as at the beginning

  // Says that the labels or the arcs of a node have changed since the last propagation.
  void Enqueue(int node) { Enqueue(node, kManyArcs); }

  void ClearQueue();  // when the labels are undone to a state that was consistent

  // Makes everything consistent that was, but for the nodes enqueued. False at a wipe-out: the
  // label sets are then in between, and the caller undoes them.
  bool Propagate(LabelStore& labels, Counters& counters);

 private:
  enum class Revision { kUnchanged, kChanged, kWipedOut };
  static constexpr int kManyArcs = -1;

  void Enqueue(int node, int arc);
  int TakeSmallest(const LabelStore& labels);
  bool ReviseAround(int node, LabelStore& labels, Counters& counters);
  Revision Revise(const Direction& direction, int changed, LabelStore& labels);
  Revision Replace(int node, LabelStore& labels);
  void KeepSupported(const Direction& direction, int changed, const LabelStore& labels);
  void DropUnsupported(const Direction& direction, int changed, const LabelStore& labels);
  bool HasSupport(const Direction& direction, Label label, std::span<const Word> others);

  std::vector<std::vector<Direction>> at_;
  std::vector<double> weights_;
  std::vector<std::uint16_t> residues_;
  std::vector<Word> kept_;  // the labels that survive the revision at hand

  std::vector<int> queue_;
  // For a node in the queue: the only arc whose revision changed it, else kManyArcs; kNotQueued.
  // Labels that were lost on an arc supported nothing there, so that the arc need not be revised
  // the other way on their account.
  static constexpr int kNotQueued = -2;
  std::vector<int> cause_;
};

}  // namespace assay::network
