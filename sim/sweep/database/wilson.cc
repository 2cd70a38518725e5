#include "sim/sweep/database/wilson.h"

#include <algorithm>
#include <cmath>

namespace assay::sweep {

Interval WilsonInterval(int successes, int trials) {
  constexpr double kDeviations = 1.959963984540054;  // 97.5 % quantile of the normal distribution
  if (trials == 0) return {0, 1};
  const double n = trials;
  const double rate = successes / n;
  const double z2 = kDeviations * kDeviations;
  const double centre = (rate + z2 / (2 * n)) / (1 + z2 / n);
  const double half =
      kDeviations / (1 + z2 / n) * std::sqrt(rate * (1 - rate) / n + z2 / (4 * n * n));
  // If no trial succeeded the low end is exactly 0, and if all succeeded the high end is exactly 1.
  return {successes == 0 ? 0 : std::max(0.0, centre - half),
          successes == trials ? 1 : std::min(1.0, centre + half)};
}

}  // namespace assay::sweep
