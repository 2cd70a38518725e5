#include "planner/network/label_store.h"

#include "planner/base/check.h"

namespace assay::network {

void LabelStore::AddNode(const LabelSet& labels) {
  nodes_.push_back({.offset = static_cast<int>(words_.size()),
                    .words = static_cast<int>(labels.words().size()),
                    .size = labels.size(),
                    .count = labels.count()});
  words_.insert(words_.end(), labels.words().begin(), labels.words().end());
  recorded_in_.resize(words_.size(), -1);
}

void LabelStore::RemoveLastNode() {
  words_.resize(nodes_.back().offset);
  recorded_in_.resize(words_.size());
  nodes_.pop_back();
}

Label LabelStore::First(int node) const {
  const std::span<const Word> words = Words(node);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != 0) return static_cast<int>(i) * kWordBits + std::countr_zero(words[i]);
  }
  ASSAY_CHECK(false, "node {} has no label", node);
}

void LabelStore::Replace(int node, const LabelSet& labels) {
  for (int word = 0; word < nodes_[node].words; ++word) {
    const Word before = words_[nodes_[node].offset + word];
    const Word after = labels.words()[word];
    if (after != before) SetWord(node, word, after, std::popcount(before ^ after));
  }
}

void LabelStore::Assign(int node, Label label) {
  for (int word = 0; word < nodes_[node].words; ++word) {
    const Word before = words_[nodes_[node].offset + word];
    const Word kept = word == label / kWordBits ? before & BitOf(label) : 0;
    if (kept != before) SetWord(node, word, kept, std::popcount(before ^ kept));
  }
}

void LabelStore::Remove(int node, Label label) {
  const int word = label / kWordBits;
  SetWord(node, word, words_[nodes_[node].offset + word] & ~BitOf(label), 1);
}

LabelStore::Mark LabelStore::Save() {
  ++period_;
  return trail_.size();
}

void LabelStore::Undo(Mark mark) {
  while (trail_.size() > mark) {
    const Change& change = trail_.back();
    words_[change.word] = change.value;
    nodes_[change.node].count = change.count;
    trail_.pop_back();
  }
  ++period_;
}

}  // namespace assay::network
