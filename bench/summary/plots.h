#pragma once

#include <string>

#include "bench/summary/measurements.h"

namespace assay::bench {

// A script for gnuplot that draws ratios.svg and growth.svg into the folder it is run in.
std::string PlotScript(const Measurements& measurements);

}  // namespace assay::bench
