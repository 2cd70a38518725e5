#pragma once

#include <span>
#include <vector>

#include "planner/base/interval.h"

namespace assay::check {

// The observed value at one corner of an error box, after one of several starts.
struct CornerResponse {
  const std::vector<double>* corner = nullptr;  // one entry for each error, 0 or 1
  std::size_t start = 0;
  double observed = 0;
};

// The corner and the start for which an observation may be least or greatest.
struct LikelyExtreme {
  std::vector<double> corner;
  std::size_t start = 0;
  double expected = 0;  // expected value there
};
struct LikelyExtremes {
  LikelyExtreme least, greatest;
};

// Returns the likely extremes from responses at the corners of a two-level design (Box, Hunter and
// Hunter, Statistics for Experimenters). An error's main effect is the difference between the means
// at its two ends. An observation that is monotone in each error is extreme at the corner that all
// effects point to. The chosen start is the one with the greatest, or least, mean after the effects
// are subtracted. There must be at least one response, and all corners must have the same length.
LikelyExtremes ByMainEffects(std::span<const CornerResponse> responses);

}  // namespace assay::check
