#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace assay {

// A hash of 128 bits of one text after another. Texts that differ have different ones but for an
// accident of one in 2^128; nobody is kept from making two of the same on purpose.
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
