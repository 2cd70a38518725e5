#pragma once

#include <cstdint>
#include <limits>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// An interval, relative to 1 and the coordinate, that is not split further.
inline constexpr double kNarrowest = 1e-13;

// When the search for a better bound may end.
struct StopRule {
  double gap = 0;                                           // bound and best point this near
  std::int64_t evaluations = 0;                             // of the probe, all told
  double limit = std::numeric_limits<double>::quiet_NaN();  // bound below it, or best not below

  bool IsMet(double upper_bound, double best_value) const;
};

// An upper bound of the form over the problem's box, found by splitting the box and bounding the
// parts by the rungs below; the probe learns of good feasible points on the way. Conservative since
// the parts cover all of the box but what (a) cannot hold more than elsewhere in it, by
// monotonicity or affinity, (b) surely violates an inequality or leaves the form without a value,
// or (c) cannot hold more than a feasible point already attains.
double BranchAndBound(Probe& probe, double upper_bound, const StopRule& stop);

}  // namespace assay::algebra
