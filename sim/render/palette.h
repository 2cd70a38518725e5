#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace assay::render {

// A colour on a light ground in the notation of HTML, "#rrggbb".
struct Colour {
  std::string_view hex;

  // Returns red, green and blue, each from 0 to 255.
  constexpr std::array<std::uint8_t, 3> Rgb() const { return {Byte(1), Byte(3), Byte(5)}; }

 private:
  constexpr std::uint8_t Byte(std::size_t at) const {
    return static_cast<std::uint8_t>(16 * Digit(hex[at]) + Digit(hex[at + 1]));
  }
  static constexpr int Digit(char c) { return c <= '9' ? c - '0' : c - 'a' + 10; }
};

// The colours that have a meaning, which is the same in pictures and reports. People with any kind
// of colour vision can distinguish them.
inline constexpr Colour kPredicted{"#4c9bd8"};
inline constexpr Colour kObserved{"#14202e"};
inline constexpr Colour kViolated{"#a11212"};

}  // namespace assay::render
