#include "planner/network/constraint_network/label_set.h"

#include <algorithm>
#include <bit>

#include "planner/base/check.h"

namespace assay::network {

LabelSet::LabelSet(int size) : size_(size), words_(WordsFor(size), 0) {
  ASSAY_CHECK(size >= 0 && size <= kMaxLabels, "size {}", size);
}

LabelSet LabelSet::None(int size) { return LabelSet(size); }

LabelSet LabelSet::All(int size) {
  LabelSet set(size);
  for (Word& word : set.words_) word = ~Word{0};
  if (size % kWordBits != 0) set.words_.back() = BitOf(size) - 1;
  return set;
}

LabelSet LabelSet::Of(int size, std::initializer_list<Label> labels) {
  LabelSet set(size);
  for (Label label : labels) set.insert(label);
  return set;
}

LabelSet LabelSet::OfWords(int size, std::span<const Word> words) {
  LabelSet set(size);
  ASSAY_CHECK(words.size() == set.words_.size());
  std::copy(words.begin(), words.end(), set.words_.begin());
  return set;
}

int LabelSet::count() const {
  int count = 0;
  for (Word word : words_) count += std::popcount(word);
  return count;
}

bool LabelSet::empty() const {
  return std::all_of(words_.begin(), words_.end(), [](Word word) { return word == 0; });
}

bool LabelSet::contains(Label label) const {
  return label >= 0 && label < size_ && (words_[label / kWordBits] & BitOf(label)) != 0;
}

Label LabelSet::first() const {
  ASSAY_CHECK(!empty());
  return *begin();
}

void LabelSet::insert(Label label) {
  ASSAY_CHECK(label >= 0 && label < size_, "label {} of {}", label, size_);
  words_[label / kWordBits] |= BitOf(label);
}

void LabelSet::erase(Label label) {
  ASSAY_CHECK(label >= 0 && label < size_, "label {} of {}", label, size_);
  words_[label / kWordBits] &= ~BitOf(label);
}

void LabelSet::intersect(const LabelSet& other) {
  ASSAY_CHECK(size_ == other.size_, "{} and {} labels", size_, other.size_);
  for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= other.words_[i];
}

LabelSet::Iterator::Iterator(std::span<const Word> words, int word)
    : words_(words), word_(word), rest_(word < std::ssize(words) ? words[word] : 0) {
  SkipEmptyWords();
}

Label LabelSet::Iterator::operator*() const { return word_ * kWordBits + std::countr_zero(rest_); }

LabelSet::Iterator& LabelSet::Iterator::operator++() {
  rest_ &= rest_ - 1;
  SkipEmptyWords();
  return *this;
}

LabelSet::Iterator LabelSet::Iterator::operator++(int) {
  Iterator before = *this;
  ++*this;
  return before;
}

void LabelSet::Iterator::SkipEmptyWords() {
  while (rest_ == 0 && word_ < std::ssize(words_)) {
    ++word_;
    rest_ = word_ < std::ssize(words_) ? words_[word_] : 0;
  }
}

}  // namespace assay::network
