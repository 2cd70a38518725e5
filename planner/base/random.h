#pragma once

#include <cstdint>
#include <string_view>

namespace assay {

// A stream of random numbers that depends only on its seed and name. It is the same on every
// machine and with every standard library, and it is independent of streams with other names. The
// generator is SplitMix64 (Steele, Lea and Flood 2014).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  std::uint64_t Next();                     // all 64 bits are uniform
  double Uniform();                         // in [0, 1), with 53 random bits
  double Uniform(double low, double high);  // in [low, high)
  int Index(int count);                     // in 0 .. count - 1, unbiased; count > 0

 private:
  std::uint64_t state_;
};

}  // namespace assay
