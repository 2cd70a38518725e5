#pragma once

#include <optional>

#include "planner/base/interval.h"

namespace assay::probability {

// The distribution of one error, with the mean 0 if it is normal.
struct ErrorDistribution {
  enum class Shape { kUniform, kNormal };
  Shape shape = Shape::kUniform;
  Interval range;        // uniform: where it lies; normal: where it is cut off, if it is
  double deviation = 0;  // standard deviation of a normal distribution, before it is cut off

  bool IsCutOff() const;
  // Returns the probability that the error is at most `value`.
  double AtMost(double value) const;
};

// A normal distribution that is not cut off has an infinite range.
ErrorDistribution Uniform(const Interval& range);
ErrorDistribution Normal(double deviation);
ErrorDistribution NormalWithin(double deviation, const Interval& range);

// Returns the probability that a standard normal number is at most `value`.
double StandardNormalAtMost(double value);

}  // namespace assay::probability
