#include "sim/report/html/data_uri.h"

#include <fmt/format.h>

#include <cstdint>

namespace assay::report {
namespace {

std::string Base64(std::string_view contents) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * (contents.size() / 3 + 1));
  for (std::size_t i = 0; i < contents.size(); i += 3) {
    const std::string_view three = contents.substr(i, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (k < three.size() ? static_cast<unsigned char>(three[k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= three.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

}  // namespace

std::string DataUri(std::string_view media_type, std::string_view contents) {
  return fmt::format("data:{};base64,{}", media_type, Base64(contents));
}

}  // namespace assay::report
