#pragma once

#include <array>
#include <cstddef>

namespace assay::kinematics {

// A list of at most N entries that needs no memory allocation.
template <typename Entry, std::size_t N>
class BoundedList {
 public:
  const Entry* begin() const { return entries_.data(); }
  const Entry* end() const { return entries_.data() + size_; }
  const Entry& operator[](std::size_t i) const { return entries_[i]; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  // Adds an entry. The list must have fewer than N entries.
  void push_back(const Entry& entry) { entries_[size_++] = entry; }

 private:
  std::array<Entry, N> entries_ = {};
  std::size_t size_ = 0;
};

}  // namespace assay::kinematics
