#include "planner/network/constraint_network/label_store.h"

#include "planner/base/check.h"

namespace assay::network {

void LabelStore::AddNode(const LabelSet& labels) {
  const std::span<const Word> words = labels.words();
  nodes_.push_back({.word = words.size() == 1 ? words[0] : 0,
                    .recorded_in = -1,
                    .count = labels.count(),
                    .size = labels.size(),
                    .words = static_cast<int>(words.size()),
                    .offset = static_cast<int>(wide_.size())});
  if (words.size() > 1) wide_.insert(wide_.end(), words.begin(), words.end());
}

void LabelStore::RemoveLastNode() {
  wide_.resize(nodes_.back().offset);
  nodes_.pop_back();
}

Label LabelStore::First(int node) const {
  const std::span<const Word> words = Words(node);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != 0) return static_cast<int>(i) * kWordBits + std::countr_zero(words[i]);
  }
  ASSAY_CHECK(false, "node {} has no label", node);
}

void LabelStore::SetWord(int node, int word, Word value) {
  Node& at = nodes_[node];
  if (at.words == 1) return SetOneWord(node, value);
  Word& present = wide_[at.offset + word];
  // Every change is recorded. Undo restores them in reverse, so that the oldest count is restored
  // last.
  trail_.push_back({.node = node, .word = word, .count = at.count, .value = present});
  at.count -= std::popcount(present ^ value);
  present = value;
}

void LabelStore::Replace(int node, const LabelSet& labels) {
  for (int word = 0; word < nodes_[node].words; ++word) {
    if (labels.words()[word] != Words(node)[word]) SetWord(node, word, labels.words()[word]);
  }
}

void LabelStore::Assign(int node, Label label) {
  for (int word = 0; word < nodes_[node].words; ++word) {
    const Word before = Words(node)[word];
    const Word kept = word == label / kWordBits ? before & BitOf(label) : 0;
    if (kept != before) SetWord(node, word, kept);
  }
}

void LabelStore::Remove(int node, Label label) {
  const int word = label / kWordBits;
  SetWord(node, word, Words(node)[word] & ~BitOf(label));
}

LabelStore::Mark LabelStore::Save() {
  ++period_;
  return trail_.size();
}

void LabelStore::Undo(Mark mark) {
  while (trail_.size() > mark) {
    const Change& change = trail_.back();
    Node& at = nodes_[change.node];
    (at.words == 1 ? at.word : wide_[at.offset + change.word]) = change.value;
    at.count = change.count;
    trail_.pop_back();
  }
  ++period_;
}

}  // namespace assay::network
