#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "planner/algebra/expression/intern_table.h"

namespace assay::algebra {

// Values by indices of expressions: what std::map does, in two pieces of memory. Values move when
// others are added.
template <class Value>
class IndexMap {
 public:
  // Null if there is none.
  Value* Find(int index) { return At(Place(index)); }
  const Value* Find(int index) const { return At(Place(index)); }

  // The value, and whether it is new: default-constructed.
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

}  // namespace assay::algebra
