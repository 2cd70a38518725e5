#pragma once

#include <cstdint>
#include <string_view>

namespace assay {

// A stream of random numbers that depends on its seed and name alone: the same on every machine
// and with every standard library, and independent of streams with other names. The generator is
// SplitMix64 (Steele, Lea and Flood 2014).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::string_view name);

  std::uint64_t Next();                     // all 64 bits uniform
  double Uniform();                         // in [0, 1), 53 bits
  double Uniform(double low, double high);  // in [low, high)
  int Index(int count);                     // in 0 .. count - 1; count > 0; unbiased

 private:
  std::uint64_t state_;
};

}  // namespace assay
