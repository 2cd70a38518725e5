#include "planner/probability/error_distribution.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace assay::probability {

double StandardNormalAtMost(double value) { return 0.5 * std::erfc(-value / std::numbers::sqrt2); }

bool ErrorDistribution::IsCutOff() const { return std::isfinite(range.high); }

double ErrorDistribution::AtMost(double value) const {
  if (value <= range.low) return 0;
  if (value >= range.high) return 1;
  if (shape == Shape::kUniform) return (value - range.low) / (range.high - range.low);
  const double below = StandardNormalAtMost(range.low / deviation);
  const double within = StandardNormalAtMost(range.high / deviation) - below;
  return std::clamp((StandardNormalAtMost(value / deviation) - below) / within, 0.0, 1.0);
}

ErrorDistribution Uniform(const Interval& range) {
  return {.shape = ErrorDistribution::Shape::kUniform, .range = range};
}

ErrorDistribution Normal(double deviation) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return NormalWithin(deviation, {-kInfinity, kInfinity});
}

ErrorDistribution NormalWithin(double deviation, const Interval& range) {
  return {ErrorDistribution::Shape::kNormal, range, deviation};
}

}  // namespace assay::probability
