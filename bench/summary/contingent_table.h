#pragma once

#include <string>

#include "bench/summary/measurements.h"

namespace assay::bench {

// Markdown: what contingent_bench says of each public problem of contingent planning, beside a
// peer's published figures.
std::string ContingentTable(const Measurements& measurements);

}  // namespace assay::bench
