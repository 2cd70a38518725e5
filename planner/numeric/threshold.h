#pragma once

#include <algorithm>
#include <functional>
#include <optional>

namespace assay {

// The numbers between which something begins to fail. `fails` is missing if nothing fails up to the
// greatest number.
struct Threshold {
  double holds = 0;
  std::optional<double> fails = {};
};

// Doubles the number from `first` until it fails, and then halves the interval until `fails` is at
// most `precision` (a ratio) greater than `holds`, or until `fails` is less than 1/64.
inline Threshold FindThreshold(const std::function<bool(double)>& fails, double first,
                               double greatest, double precision) {
  constexpr double kLeast = 1.0 / 64;
  Threshold threshold;
  for (double number = std::min(first, greatest); !threshold.fails;
       number = std::min(2 * number, greatest)) {
    if (fails(number)) {
      threshold.fails = number;
    } else {
      threshold.holds = number;
      if (number >= greatest) return threshold;
    }
  }
  while (*threshold.fails - threshold.holds > precision * *threshold.fails &&
         *threshold.fails > kLeast) {
    const double middle = (threshold.holds + *threshold.fails) / 2;
    if (fails(middle)) {
      threshold.fails = middle;
    } else {
      threshold.holds = middle;
    }
  }
  return threshold;
}

}  // namespace assay
