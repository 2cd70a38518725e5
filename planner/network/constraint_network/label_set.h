#pragma once

#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <span>
#include <vector>

namespace assay::network {

// A possible value of a node: an index into the caller's table of values.
using Label = int;

// Label sets are stored in words of 64 labels. Label l is bit l % 64 of word l / 64. Bits beyond
// the last label are zero.
using Word = std::uint64_t;
inline constexpr int kWordBits = 64;
constexpr int WordsFor(int size) { return (size + kWordBits - 1) / kWordBits; }
constexpr Word BitOf(Label label) { return Word{1} << (label % kWordBits); }

// The greatest number of labels of a node.
inline constexpr int kMaxLabels = 1 << 16;

// A subset of the labels 0 .. size() - 1.
class LabelSet {
 public:
  LabelSet() = default;
  static LabelSet None(int size);  // 0 <= size <= kMaxLabels
  static LabelSet All(int size);
  static LabelSet Of(int size, std::initializer_list<Label> labels);
  static LabelSet OfWords(int size, std::span<const Word> words);

  int size() const { return size_; }  // the number of possible members
  int count() const;                  // the number of members
  bool empty() const;
  bool contains(Label label) const;  // false for labels outside 0 .. size() - 1
  Label first() const;               // the least member; the set must not be empty

  void insert(Label label);
  void erase(Label label);
  void intersect(const LabelSet& other);  // both sets must have the same size

  std::span<const Word> words() const { return words_; }
  bool operator==(const LabelSet&) const = default;

  // Iterates over the members in increasing order.
  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Label;
    using difference_type = std::ptrdiff_t;
    using pointer = const Label*;
    using reference = Label;

    Iterator(std::span<const Word> words, int word);
    Label operator*() const;
    Iterator& operator++();
    Iterator operator++(int);
    bool operator==(const Iterator& other) const {
      return word_ == other.word_ && rest_ == other.rest_;
    }

   private:
    void SkipEmptyWords();

    std::span<const Word> words_;
    int word_;
    Word rest_;  // members of the current word that are still to be visited
  };
  Iterator begin() const { return Iterator(words_, 0); }
  Iterator end() const { return Iterator(words_, static_cast<int>(words_.size())); }

 private:
  explicit LabelSet(int size);

  int size_ = 0;
  std::vector<Word> words_;
};

}  // namespace assay::network
