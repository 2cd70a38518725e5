#pragma once

#include <string>
#include <vector>

#include "bench/summary/measurements.h"

namespace assay::bench {

// Times of one kind of work by its size: the number that ends a benchmark's name, or its counter
// "size".
struct Growth {
  struct Point {
    double size = 0;
    double seconds = 0;
  };
  std::string program;        // as of Series
  std::string name;           // without the size
  std::string of;             // what the size is of: "tolerances"; empty if it is not said
  std::vector<Point> points;  // by size

  // Of the power law that is nearest in logarithms: time grows as size to this power.
  double Exponent() const;
};

// Of all benchmarks with at least three sizes, in the order in which they ran.
std::vector<Growth> Growths(const Measurements& measurements);

}  // namespace assay::bench
