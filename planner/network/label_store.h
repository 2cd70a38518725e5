#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/base/id.h"
#include "planner/network/label_set.h"

namespace assay::network {

using NodeId = Id<struct NodeTag>;

// The label sets of all nodes of a network, side by side in one array, with a trail: label sets
// only shrink, and shrink back open only by undoing to an earlier mark, last change first.
class LabelStore {
 public:
  using Mark = std::size_t;  // a length of the trail

  void AddNode(const LabelSet& labels);
  void RemoveLastNode();  // nothing of it may be left on the trail

  int node_count() const { return static_cast<int>(nodes_.size()); }
  int size(int node) const { return nodes_[node].size; }
  int count(int node) const { return nodes_[node].count; }
  bool Contains(int node, Label label) const {
    return (words_[nodes_[node].offset + label / kWordBits] & BitOf(label)) != 0;
  }
  Label First(int node) const;  // the least label; there is one
  std::span<const Word> Words(int node) const {
    return {words_.data() + nodes_[node].offset, static_cast<std::size_t>(nodes_[node].words)};
  }
  LabelSet Labels(int node) const { return LabelSet::OfWords(size(node), Words(node)); }

  // Changes to one label set. SetWord replaces its word `word` by a subset of it.
  void SetWord(int node, int word, Word value, int removed_count);
  void Replace(int node, const LabelSet& labels);  // by a subset
  void Assign(int node, Label label);              // a member becomes the only one
  void Remove(int node, Label label);              // a member is taken out

  Mark Save();
  void Undo(Mark mark);

 private:
  struct Node {
    int offset;  // of its first word
    int words;
    int size;
    int count;
  };
  struct Change {
    int node;
    int word;  // in words_
    Word value;
    int count;
  };

  std::vector<Node> nodes_;
  std::vector<Word> words_;
  // The period between two marks in which a word was last put on the trail: within one period the
  // first value is the one to come back to, so that later ones need not be recorded.
  std::vector<std::int64_t> recorded_in_;
  std::int64_t period_ = 0;
  std::vector<Change> trail_;
};

inline void LabelStore::SetWord(int node, int word, Word value, int removed_count) {
  Node& at = nodes_[node];
  const int index = at.offset + word;
  // The count belongs to the node, not to the word, so a node of several words records every
  // change: undone in reverse, the oldest count comes back last.
  if (recorded_in_[index] != period_ || at.words > 1) {
    recorded_in_[index] = period_;
    trail_.push_back({.node = node, .word = index, .value = words_[index], .count = at.count});
  }
  words_[index] = value;
  at.count -= removed_count;
}

}  // namespace assay::network
