#include "planner/base/random.h"

#include "planner/base/check.h"

namespace assay {
namespace {

std::uint64_t Mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

// Hashes the name by FNV-1a, so that the name works as a second seed.
std::uint64_t HashName(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (unsigned char c : name) hash = (hash ^ c) * 0x100000001b3ULL;
  return hash;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view name)
    : state_(Mix(seed) ^ HashName(name)) {}

std::uint64_t RandomStream::Next() { return Mix(state_ += 0x9e3779b97f4a7c15ULL); }

double RandomStream::Uniform() { return static_cast<double>(Next() >> 11) * 0x1.0p-53; }

double RandomStream::Uniform(double low, double high) { return low + (high - low) * Uniform(); }

int RandomStream::Index(int count) {
  ASSAY_CHECK(count > 0);
  const auto n = static_cast<std::uint64_t>(count);
  const std::uint64_t unbiased = ~0ULL - ~0ULL % n;  // a multiple of n, so no index is favoured
  std::uint64_t draw = Next();
  while (draw >= unbiased) draw = Next();
  return static_cast<int>(draw % n);
}

}  // namespace assay
