#pragma once

#include <cstdint>
#include <limits>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// An interval narrower than this, relative to 1 plus the coordinate's magnitude, is not split
// further.
inline constexpr double kNarrowest = 1e-13;

// Decides when the search for a better bound ends.
struct StopRule {
  double gap = 0;                // ends when bound and best point differ by at most this
  std::int64_t evaluations = 0;  // the greatest count of the probe's evaluations
  // The search ends when the upper bound is below this limit, or when a value that is at least the
  // limit was found.
  double limit = std::numeric_limits<double>::quiet_NaN();

  bool IsMet(double upper_bound, double best_value) const;
};

// Returns an upper bound of the form over the problem's box. It splits the box and bounds the parts
// by the cheaper methods. The probe keeps good feasible points that are found on the way. The bound
// is conservative because the parts cover the whole box except for three kinds of regions. In
// regions of the first kind, by monotonicity or affinity, the form is nowhere larger than elsewhere
// in the box. Regions of the second kind surely violate an inequality, or the form has no value in
// them. In regions of the third kind, the form cannot exceed a value that a feasible point attains.
double BranchAndBound(Probe& probe, double upper_bound, const StopRule& stop);

}  // namespace assay::algebra
