#pragma once

#include <string>
#include <vector>

#include "bench/summary/measurements.h"

namespace assay::bench {

std::string Time(double seconds);    // for example "1.25 ms"; "-" if not finite
std::string Multiple(double ratio);  // three digits; a whole number from 100 on

// Return a row of a table, and a heading with the line below it.
std::string Row(const std::vector<std::string>& cells);
std::string Heading(const std::vector<std::string>& cells);

// Returns a section with the machine, the compiler, the revision and the settings of the run.
std::string Where(const Measurements& measurements);

}  // namespace assay::bench
