#include "sim/check/contact_sequences/rank_correlation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/base/check.h"

namespace assay::check {

std::vector<double> RanksOf(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) ++last;
    for (std::size_t k = first; k <= last; ++k)
      ranks[order[k]] = static_cast<double>(first + last) / 2 + 1;
    first = last + 1;
  }
  return ranks;
}

std::optional<double> RankCorrelation(std::span<const double> x, std::span<const double> y) {
  ASSAY_CHECK(x.size() == y.size());
  // The mean of the ranks is the same with and without ties.
  const double mean = (static_cast<double>(x.size()) + 1) / 2;
  const std::vector<double> a = RanksOf(x);
  const std::vector<double> b = RanksOf(y);
  double ab = 0;
  double aa = 0;
  double bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean) * (b[i] - mean);
    aa += (a[i] - mean) * (a[i] - mean);
    bb += (b[i] - mean) * (b[i] - mean);
  }
  if (aa == 0 || bb == 0) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

}  // namespace assay::check
