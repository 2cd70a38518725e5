#pragma once

#include <cstdint>
#include <vector>

#include "planner/network/network/counters.h"
#include "planner/network/network/label_store.h"
#include "planner/network/network/relation.h"

namespace assay::network {

// Arc consistency over the label sets of a store: every label keeps a support on every arc.
// AC-3 with a queue of nodes (Mackworth 1977; McGregor 1979), small label sets first, label sets
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
    int next;               // of the same node, or kNoDirection
    const Word* supports;   // of each label of the revised node
    const Word* supported;  // by each label of the changed node
  };

  // Arcs and nodes come and go last in, first out. Relations must outlive their arcs. The two
  // nodes of an arc differ: an arc from a node to itself is a restriction of its labels.
  void AddNode();
  void RemoveLastNode();
  void AddArc(int arc, int a, int b, const Relation& relation);
  void RemoveLastArc(int a, int b);

  // The directions kept at one node, last arc first.
  class Directions;
  Directions at(int node) const;

  std::int64_t weight(int arc) const { return weights_[arc]; }
  void ForgetWeights();  // all equal, as at the beginning

  // Where the last wipe-out happened: the arc, and its ends.
  struct WipeOut {
    int arc, changed, revised;
  };
  const WipeOut& last_wipe_out() const { return last_wipe_out_; }

  // Says that the labels or the arcs of a node have changed since the last propagation.
  void Enqueue(int node) { Enqueue(node, kManyArcs); }

  void ClearQueue();  // when the labels are undone to a state that was consistent

  // Makes everything consistent that was, but for the nodes enqueued. False at a wipe-out: the
  // label sets are then in between, and the caller undoes them.
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
  std::vector<int> first_at_;          // by node: the head of a list in directions_
  std::vector<std::int64_t> weights_;
  WipeOut last_wipe_out_ = {};
  std::vector<std::uint16_t> residues_;
  std::vector<Word> kept_;  // the labels that survive the revision at hand

  std::vector<int> queue_;
  // For a node in the queue: the only arc whose revision changed it, else kManyArcs; kNotQueued.
  // Labels that were lost on an arc supported nothing there, so that the arc need not be revised
  // the other way on their account.
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
