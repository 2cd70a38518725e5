#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "planner/base/intern_table.h"

namespace assay {

// A hash map from indices to values. It replaces std::map and uses two blocks of memory. Adding a
// value may move the others in memory.
template <class Value>
class IndexMap {
 public:
  // Returns null if the index has no value.
  Value* Find(int index) { return At(Place(index)); }
  const Value* Find(int index) const { return At(Place(index)); }

  // Returns the value of the index, and true if it was added (default-constructed) by this call.
  std::pair<Value&, bool> Insert(int index) {
    if (Value* known = Find(index)) return {*known, false};
    table_.Insert(HashOf(index), static_cast<int>(entries_.size()));
    return {entries_.emplace_back(index, Value()).second, true};
  }
  Value& operator[](int index) { return Insert(index).first; }

 private:
  using Entry = std::pair<int, Value>;

  static std::uint64_t HashOf(int index) { return MixedHash(0, static_cast<std::uint64_t>(index)); }

  int Place(int index) const {
    return table_.Find(HashOf(index), [&](int place) { return entries_[place].first == index; });
  }
  Value* At(int place) { return place < 0 ? nullptr : &entries_[place].second; }
  const Value* At(int place) const { return place < 0 ? nullptr : &entries_[place].second; }

  InternTable table_;
  std::vector<Entry> entries_;
};

}  // namespace assay
