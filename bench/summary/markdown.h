#pragma once

#include <string>
#include <vector>

#include "bench/summary/measurements.h"

namespace assay::bench {

std::string Time(double seconds);    // "1.25 ms"; "-" if it is not finite
std::string Multiple(double ratio);  // three digits, whole from 100 on

// Of a table.
std::string Row(const std::vector<std::string>& cells);
std::string Heading(const std::vector<std::string>& cells);

// A section: machine, compiler, revision, and what the run was asked.
std::string Where(const Measurements& measurements);

}  // namespace assay::bench
