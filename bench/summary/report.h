#pragma once

#include <string>

#include "bench/summary/measurements.h"

namespace assay::bench {

// Markdown: headline, ratios of every instance with their spread over the passes, growth with
// fitted exponents, what stands alone, what makes comparisons unfair, and where it was measured.
std::string Report(const Measurements& measurements);

}  // namespace assay::bench
