#pragma once

#include <string>

#include "bench/summary/measurements.h"

namespace assay::bench {

// Returns the report in Markdown: a headline, the ratios of every instance with their spread over
// the passes, growth with fitted exponents, times without a peer, what makes comparisons unfair,
// and where it was measured.
std::string Report(const Measurements& measurements);

}  // namespace assay::bench
