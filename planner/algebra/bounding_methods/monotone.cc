#include "planner/algebra/bounding_methods/monotone.h"

#include <cmath>

namespace assay::algebra {
namespace {

// Sets the interval to its best end if the derivative has one sign. Returns true if the interval
// became smaller.
bool SetToBestEnd(Interval& interval, const Interval& derivative) {
  const bool rises = derivative.low >= 0;
  const bool falls = derivative.high <= 0;
  if (interval.low == interval.high || (!rises && !falls)) return false;
  const double end = rises ? interval.high : interval.low;
  if (!std::isfinite(end)) return false;
  interval = {end, end};
  return true;
}

}  // namespace

MonotoneBox SetMonotoneVariables(Probe& probe, Box box, const std::vector<bool>& held) {
  while (true) {
    const Interval range = probe.Range(box);
    const std::vector<Interval>& gradient = probe.GradientOverBox();
    bool is_smaller = false;
    if (probe.over_box().DefinedEverywhere()) {
      for (std::size_t i = 0; i < box.size(); ++i) {
        if (!held.empty() && held[i]) continue;
        is_smaller = SetToBestEnd(box[i], gradient[i]) || is_smaller;
      }
    }
    if (!is_smaller) return {std::move(box), range, gradient};
  }
}

}  // namespace assay::algebra
