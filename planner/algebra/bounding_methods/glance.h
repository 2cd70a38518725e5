#pragma once

#include <span>

#include "planner/algebra/expression/expression.h"
#include "planner/base/interval.h"

namespace assay::algebra {

// A cheap bound of an expression as it is stored, without its normal form. It is looser than the
// other bounding methods and costs a small part of their work. Usually this bound is enough to
// decide on which side of a limit the expression stays.
struct Glance {
  double bound = 0;     // guaranteed: the expression never crosses it in the box
  double attained = 0;  // The expression reaches at least this value somewhere in the box. If no
                        // point is known, it is the infinity opposite to the bound.
};

// Return a bound of e from above and from below, over a box that is indexed by VariableId. The work
// ends as soon as the bound proves that e does not reach the limit.
Glance GlanceAbove(const Expression& e, std::span<const Interval> box, double limit);
Glance GlanceBelow(const Expression& e, std::span<const Interval> box, double limit);

}  // namespace assay::algebra
