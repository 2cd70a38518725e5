#pragma once

#include <string>

#include "bench/summary/measurements.h"

namespace assay::bench {

// Returns a script for gnuplot that draws ratios.svg and growth.svg into the current folder.
std::string PlotScript(const Measurements& measurements);

}  // namespace assay::bench
