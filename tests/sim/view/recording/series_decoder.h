#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace assay::view {

// Decodes series as sim/view/page/data.md defines them.
class SeriesDecoder {
 public:
  explicit SeriesDecoder(std::string bytes) : bytes_(std::move(bytes)) {}

  std::vector<std::int64_t> Next(std::size_t count) {
    const int order = Byte();
    std::vector<std::int64_t> values;
    std::uint64_t zeros = 0;
    while (values.size() < count) {
      std::uint64_t code = 0;
      if (zeros > 0) {
        --zeros;
      } else if (code = Number(); code == 0) {
        zeros = Number();
      }
      const auto half = static_cast<std::int64_t>(code / 2);
      const std::size_t n = values.size();
      std::int64_t expected = n > 0 ? values[n - 1] : 0;
      if (order == 2 && n > 1) expected = 2 * values[n - 1] - values[n - 2];
      values.push_back(expected + (code % 2 == 0 ? half : -half - 1));
    }
    return values;
  }
  bool IsAtEnd() const { return at_ == bytes_.size(); }

 private:
  int Byte() { return static_cast<unsigned char>(bytes_.at(at_++)); }
  std::uint64_t Number() {
    std::uint64_t number = 0;
    for (int shift = 0;; shift += 7) {
      const int byte = Byte();
      number |= static_cast<std::uint64_t>(byte & 127) << shift;
      if (byte < 128) return number;
    }
  }

  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace assay::view
