#pragma once

#include <string>

#include "bench/summary/measurements.h"

namespace assay::bench {

// Returns the report in Markdown. It has a headline, the ratios of every instance with their spread
// over the passes, growth with fitted exponents, and times without a peer. It also states the
// reasons why comparisons are unfair, and the machine.
std::string Report(const Measurements& measurements);

}  // namespace assay::bench
