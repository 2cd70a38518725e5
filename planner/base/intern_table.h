#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace assay {

// A hash table of the indices of objects that are stored elsewhere, each once. It uses open
// addressing with linear probing. Nothing iterates over it, so results are deterministic.
class InternTable {
 public:
  // Returns the stored index that has this hash and satisfies `is_equal(index)`, or -1.
  template <class IsEqual>
  int Find(std::uint64_t hash, const IsEqual& is_equal) const {
    if (slots_.empty()) return -1;
    for (std::size_t at = hash & mask(); slots_[at].index >= 0; at = (at + 1) & mask()) {
      if (slots_[at].hash == Kept(hash) && is_equal(slots_[at].index)) return slots_[at].index;
    }
    return -1;
  }

  // Adds an index that Find did not find.
  void Insert(std::uint64_t hash, int index) {
    if (2 * (count_ + 1) > slots_.size()) Grow();
    Place({Kept(hash), index});
    ++count_;
  }

 private:
  struct Slot {  // kept small, because most of the time goes into fetching one
    std::uint32_t hash = 0;
    int index = -1;
  };

  static std::uint32_t Kept(std::uint64_t hash) { return static_cast<std::uint32_t>(hash); }
  std::size_t mask() const { return slots_.size() - 1; }

  void Place(const Slot& slot) {
    std::size_t at = slot.hash & mask();
    while (slots_[at].index >= 0) at = (at + 1) & mask();
    slots_[at] = slot;
  }

  void Grow() {
    const std::vector<Slot> old = std::move(slots_);
    slots_.assign(old.empty() ? 16 : 2 * old.size(), {});
    for (const Slot& slot : old) {
      if (slot.index >= 0) Place(slot);
    }
  }

  std::vector<Slot> slots_;  // the number of slots is a power of two
  std::size_t count_ = 0;
};

// Returns `hash` combined with one more word.
inline std::uint64_t MixedHash(std::uint64_t hash, std::uint64_t word) {
  const std::uint64_t mixed = (hash ^ word) * 0x9E3779B97F4A7C15U;
  return mixed ^ (mixed >> 32U);
}

}  // namespace assay
