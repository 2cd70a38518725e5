#include "planner/base/digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace assay {
namespace {

// This is a bijection both of `hash` and of `word` (Stafford's variant 13 of MurmurHash3's final
// steps).
std::uint64_t Mixed(std::uint64_t hash, std::uint64_t word) {
  std::uint64_t z = hash + 0x9E3779B97F4A7C15U + word;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

}  // namespace

// The size is added first, so that the borders between texts influence the hash.
Digest& Digest::Add(std::string_view text) {
  Add(static_cast<std::uint64_t>(text.size()));
  for (std::uint64_t word = 0; !text.empty(); word = 0) {
    const std::size_t bytes = std::min(text.size(), sizeof word);
    std::memcpy(&word, text.data(), bytes);
    text.remove_prefix(bytes);
    Add(word);
  }
  return *this;
}

std::string Digest::Hex() const { return fmt::format("{:016x}{:016x}", first_, second_); }

void Digest::Add(std::uint64_t word) {
  first_ = Mixed(first_, word);
  second_ = Mixed(second_, ~word);
}

}  // namespace assay
