#pragma once

#include <string>

#include "bench/summary/measurements.h"

namespace assay::bench {

// Returns a table in Markdown: the results of contingent_bench for each public problem of
// contingent planning, beside a peer's published figures.
std::string ContingentTable(const Measurements& measurements);

}  // namespace assay::bench
