#include "sim/view/recording/series.h"

#include <cstddef>

namespace assay::view {
namespace {

// Collects numbers without sign, seven bits in each byte, the lowest first. Zeros are counted.
class RunWriter {
 public:
  explicit RunWriter(int order) : bytes_(1, static_cast<char>(order)) {}

  void Add(std::uint64_t number) {
    if (number == 0) {
      ++zeros_;
      return;
    }
    EndRun();
    Write(number);
  }
  std::string Take() {
    EndRun();
    return std::move(bytes_);
  }

 private:
  void EndRun() {
    if (zeros_ == 0) return;
    bytes_ += '\0';
    Write(zeros_ - 1);
    zeros_ = 0;
  }
  void Write(std::uint64_t number) {
    for (; number >= 128; number /= 128) bytes_ += static_cast<char>(number % 128 + 128);
    bytes_ += static_cast<char>(number);
  }

  std::string bytes_;
  std::uint64_t zeros_ = 0;
};

std::uint64_t WithoutSign(std::int64_t value) {
  return value < 0 ? 2 * static_cast<std::uint64_t>(-(value + 1)) + 1
                   : 2 * static_cast<std::uint64_t>(value);
}

// Encodes the differences from a constant continuation (order 1) or a linear one (order 2).
std::string EncodedDifferences(std::span<const std::int64_t> values, int order) {
  RunWriter writer(order);
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::int64_t expected = i > 0 ? values[i - 1] : 0;
    if (order == 2 && i > 1) expected += values[i - 1] - values[i - 2];
    writer.Add(WithoutSign(values[i] - expected));
  }
  return writer.Take();
}

}  // namespace

std::string EncodedSeries(std::span<const std::int64_t> values) {
  std::string constant = EncodedDifferences(values, 1);
  std::string linear = EncodedDifferences(values, 2);
  return linear.size() < constant.size() ? linear : constant;
}

}  // namespace assay::view
