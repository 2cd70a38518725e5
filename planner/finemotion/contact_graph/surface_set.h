#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace assay::finemotion {

// A set of C-surfaces, with one bit for each surface. Searches of contact states compare and hash
// such sets all the time, so these functions stand in a header.
using SurfaceSet = std::vector<std::uint64_t>;

inline void Insert(SurfaceSet& set, int surface) {
  set[static_cast<std::size_t>(surface) / 64] |= std::uint64_t{1} << (surface % 64);
}

inline bool Contains(const SurfaceSet& set, int surface) {
  return (set[static_cast<std::size_t>(surface) / 64] >> (surface % 64) & 1) != 0;
}

inline bool IsSubset(const SurfaceSet& part, const SurfaceSet& set) {
  for (std::size_t i = 0; i < set.size(); ++i) {
    if ((part[i] & ~set[i]) != 0) return false;
  }
  return true;
}

struct HashOfSet {
  std::size_t operator()(const SurfaceSet& set) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : set) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

}  // namespace assay::finemotion
