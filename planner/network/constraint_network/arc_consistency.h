#pragma once

#include <cstdint>
#include <vector>

#include "planner/network/constraint_network/counters.h"
#include "planner/network/constraint_network/label_store.h"
#include "planner/network/constraint_network/relation.h"

namespace assay::network {

// Arc consistency over the label sets of a store: every label keeps a support on every arc. The
// algorithm is AC-3 with a queue of nodes, small label sets first (Mackworth 1977; McGregor 1979).
// Label sets and supports are words of bits (Lecoutre and Vion 2008). In sets of several words, the
// word of the last support is remembered (residual supports, Lecoutre and Hemery 2007).
//
// Each wipe-out adds to the weight of the arc at which it happened. The variable order of searches
// uses these weights (Boussemart, Hemery, Lecoutre and Sais 2004).
class ArcConsistency {
 public:
  // One direction of an arc. It is stored at the node whose change requires the revision.
  struct Direction {
    int revised;            // the node at the other end, whose labels are revised
    int arc;                // the index that was given to AddArc
    int most_unsupporting;  // greatest number of labels of the changed node that one revised label
                            // forbids
    int residues;           // index of the first label's residual support
    int next;               // the next direction of the same node, or kNoDirection
    const Word* supports;   // the supports of each label of the revised node
    const Word* supported;  // the labels that each label of the changed node supports
  };

  // Arcs and nodes are removed in the reverse of the order in which they were added. Relations must
  // outlive their arcs. The two nodes of an arc must differ, since an arc from a node to itself is
  // a restriction of its labels.
  void AddNode();
  void RemoveLastNode();
  void AddArc(int arc, int a, int b, const Relation& relation);
  void RemoveLastArc(int a, int b);

  // The directions that are stored at one node, in the reverse of the order of their arcs.
  class Directions;
  Directions at(int node) const;

  std::int64_t weight(int arc) const { return weights_[arc]; }
  void ForgetWeights();  // makes all weights equal, as for a new object

  // Where the last wipe-out happened: the arc and its two nodes.
  struct WipeOut {
    int arc, changed, revised;
  };
  const WipeOut& last_wipe_out() const { return last_wipe_out_; }

  // Tells the object that the labels or the arcs of a node have changed since the last propagation.
  void Enqueue(int node) { Enqueue(node, kManyArcs); }

  // Empties the queue. Call it when the labels are undone to a consistent state.
  void ClearQueue();

  // Restores arc consistency after changes at the enqueued nodes. Returns false at a wipe-out. The
  // label sets are then only partly revised, and the caller must undo them.
  bool Propagate(LabelStore& labels, Counters& counters);

 private:
  enum class Revision { kUnchanged, kChanged, kWipedOut };
  static constexpr int kManyArcs = -1;
  static constexpr int kNoDirection = -1;

  void Enqueue(int node, int arc);
  int TakeSmallest(const LabelStore& labels);
  bool IsSettled(int node, const LabelStore& labels) const;
  bool ReviseAround(int node, LabelStore& labels, Counters& counters);
  Revision Revise(const Direction& direction, int changed, LabelStore& labels);
  Revision ReviseWide(const Direction& direction, int changed, LabelStore& labels);
  Revision Replace(int node, LabelStore& labels);
  void KeepSupported(const Direction& direction, int changed, const LabelStore& labels);
  void DropUnsupported(const Direction& direction, int changed, const LabelStore& labels);
  bool HasSupport(const Direction& direction, Label label, std::span<const Word> others);

  std::vector<Direction> directions_;  // two for each arc
  std::vector<int> first_at_;          // indexed by node: the head of a list in directions_
  std::vector<std::int64_t> weights_;
  WipeOut last_wipe_out_ = {};
  std::vector<std::uint16_t> residues_;
  std::vector<Word> kept_;  // the labels that survive the current revision

  std::vector<int> queue_;
  // Indexed by node. For a node in the queue: the arc whose revision changed it, or kManyArcs if
  // there are several; for other nodes: kNotQueued. Labels that a node loses by the revision of an
  // arc supported nothing on this arc. Their loss is therefore no reason to revise the arc in the
  // other direction.
  static constexpr int kNotQueued = -2;
  std::vector<int> cause_;
};

class ArcConsistency::Directions {
 public:
  class Iterator {
   public:
    Iterator(const Direction* all, int place) : all_(all), place_(place) {}
    const Direction& operator*() const { return all_[place_]; }
    Iterator& operator++() {
      place_ = all_[place_].next;
      return *this;
    }
    bool operator==(const Iterator& other) const { return place_ == other.place_; }

   private:
    const Direction* all_;
    int place_;
  };

  Directions(const Direction* all, int first) : all_(all), first_(first) {}
  Iterator begin() const { return {all_, first_}; }
  Iterator end() const { return {all_, kNoDirection}; }

 private:
  const Direction* all_;
  int first_;
};

inline ArcConsistency::Directions ArcConsistency::at(int node) const {
  return {directions_.data(), first_at_[node]};
}

}  // namespace assay::network
