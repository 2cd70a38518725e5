#pragma once

#include <string>
#include <vector>

#include "bench/summary/measurements.h"

namespace assay::bench {

// The times of one kind of work by size. The size is the number that ends a benchmark's name, or
// the benchmark's counter "size".
struct Growth {
  struct Point {
    double size = 0;
    double seconds = 0;
  };
  std::string program;        // program as in Series
  std::string name;           // name without the size
  std::string of;             // what the size counts, for example "tolerances"; may be empty
  std::vector<Point> points;  // ordered by size

  // Returns the exponent of the power law that is nearest in logarithms: time grows as size to this
  // power.
  double Exponent() const;
};

// Returns the growth of all benchmarks with at least three sizes, in the order in which they ran.
std::vector<Growth> Growths(const Measurements& measurements);

}  // namespace assay::bench
