#include "planner/algebra/multiaffine/sector.h"

#include <cmath>

namespace assay::algebra {
namespace {

constexpr double kLessThanHalfTurn = 3.1415;

// Returns the range of a sine or cosine over an interval, from its values and slopes at the ends.
// It has at most one extremum in less than half a turn.
numeric::NearestInterval RangeBetween(double low_value, double high_value, double low_slope,
                                      double high_slope) {
  numeric::NearestInterval range(std::min(low_value, high_value), std::max(low_value, high_value));
  if (low_slope > 0 && high_slope < 0) range.high = 1;
  if (low_slope < 0 && high_slope > 0) range.low = -1;
  return range;
}

}  // namespace

Phasor PhasorAt(double angle) { return {.cosine = std::cos(angle), .sine = std::sin(angle)}; }

Sector AngleBetween(double low, double high) {
  const Phasor at_low = PhasorAt(low);
  return {low, high, at_low, low < high ? PhasorAt(high) : at_low};
}

numeric::NearestInterval Cosines(const Sector& angle) {
  if (angle.Width() > kLessThanHalfTurn) return {-1, 1};
  return RangeBetween(angle.at_low.cosine, angle.at_high.cosine, -angle.at_low.sine,
                      -angle.at_high.sine);
}

numeric::NearestInterval Sines(const Sector& angle) {
  if (angle.Width() > kLessThanHalfTurn) return {-1, 1};
  return RangeBetween(angle.at_low.sine, angle.at_high.sine, angle.at_low.cosine,
                      angle.at_high.cosine);
}

}  // namespace assay::algebra
