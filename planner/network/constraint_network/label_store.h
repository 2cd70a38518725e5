#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/base/id.h"
#include "planner/network/constraint_network/label_set.h"

namespace assay::network {

using NodeId = Id<struct NodeTag>;

// The label sets of all nodes of a network, with a trail. Label sets only shrink. A label set grows
// again only if changes are undone back to an earlier mark, the last change first. A set of one
// word, the most common kind, is stored beside its count.
class LabelStore {
 public:
  using Mark = std::size_t;  // a length of the trail

  void AddNode(const LabelSet& labels);
  void RemoveLastNode();  // the trail must not contain changes of this node

  int node_count() const { return static_cast<int>(nodes_.size()); }
  int size(int node) const { return nodes_[node].size; }
  int count(int node) const { return nodes_[node].count; }
  bool Contains(int node, Label label) const {
    return (Words(node)[label / kWordBits] & BitOf(label)) != 0;
  }
  Label First(int node) const;  // the least label; the set must not be empty
  bool IsOneWord(int node) const { return nodes_[node].words == 1; }
  Word OneWord(int node) const { return nodes_[node].word; }
  std::span<const Word> Words(int node) const {
    const Node& at = nodes_[node];
    return {at.words == 1 ? &at.word : wide_.data() + at.offset,
            static_cast<std::size_t>(at.words)};
  }
  LabelSet Labels(int node) const { return LabelSet::OfWords(size(node), Words(node)); }

  // These functions change one label set. SetWord replaces word `word` of the set by a subset of
  // it.
  void SetOneWord(int node, Word value);
  void SetWord(int node, int word, Word value);
  void Replace(int node, const LabelSet& labels);  // replaces the set by a subset
  void Assign(int node, Label label);              // makes a member the only one
  void Remove(int node, Label label);              // removes a member

  Mark Save();
  void Undo(Mark mark);

 private:
  struct Node {
    Word word;  // the whole set if it has one word
    // The period between two marks in which `word` was last put on the trail. Undo returns to the
    // first value of a period, so later values within the period need not be recorded.
    std::int64_t recorded_in;
    int count;
    int size;
    int words;
    int offset;  // the place in wide_ of a set of several words
  };
  struct Change {
    int node;
    int word;
    int count;
    Word value;
  };

  std::vector<Node> nodes_;
  std::vector<Word> wide_;
  std::int64_t period_ = 0;
  std::vector<Change> trail_;
};

inline void LabelStore::SetOneWord(int node, Word value) {
  Node& at = nodes_[node];
  if (at.recorded_in != period_) {
    at.recorded_in = period_;
    trail_.push_back({.node = node, .word = 0, .count = at.count, .value = at.word});
  }
  at.word = value;
  at.count = std::popcount(value);
}

}  // namespace assay::network
