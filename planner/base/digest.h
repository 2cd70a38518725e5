#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace assay {

// A hash of 128 bits of a sequence of texts. Different texts have the same hash only with
// probability 2^-128. The hash is not cryptographic: somebody could construct two texts with the
// same hash.
class Digest {
 public:
  Digest& Add(std::string_view text);
  std::string Hex() const;  // 32 characters

 private:
  void Add(std::uint64_t word);

  std::uint64_t first_ = 0;
  std::uint64_t second_ = 0x243F6A8885A308D3U;
};

}  // namespace assay
