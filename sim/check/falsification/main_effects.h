#pragma once

#include <span>
#include <vector>

#include "planner/base/interval.h"

namespace assay::check {

// What was observed at one corner of an error box, after one of several starts.
struct CornerResponse {
  const std::vector<double>* corner = nullptr;  // 0 and 1, one for each error
  std::size_t start = 0;
  double observed = 0;
};

// Where an observation may be least or greatest.
struct LikelyExtreme {
  std::vector<double> corner;
  std::size_t start = 0;
  double expected = 0;  // there
};
struct LikelyExtremes {
  LikelyExtreme least, greatest;
};

// Of responses at the corners of a two-level design (Box, Hunter and Hunter, Statistics for
// Experimenters): each error's main effect is the difference of the means at its two ends, and an
// observation that is monotone in each error is extreme where all effects have one sign; the start
// is the one of which most, or least, is left when the effects are subtracted. At least one
// response; corners of one length.
LikelyExtremes ByMainEffects(std::span<const CornerResponse> responses);

}  // namespace assay::check
