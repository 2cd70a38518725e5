#pragma once

#include <span>

#include "planner/algebra/expression/expression.h"
#include "planner/base/interval.h"

namespace assay::algebra {

// What is seen of an expression as it stands, without bringing it to normal form: less than the
// ladder of bounds sees, for a small part of the work, and mostly enough to tell on which side of a
// limit it stays.
struct Glance {
  double bound = 0;     // guaranteed, never crossed by the expression over the box
  double attained = 0;  // the expression goes at least as far somewhere in the box; infinite on the
                        // other side if no point is known
};

// From above, and from below, over a box by VariableId. Looks no further than is needed to know
// that the bound is on this side of the limit.
Glance GlanceAbove(const Expression& e, std::span<const Interval> box, double limit);
Glance GlanceBelow(const Expression& e, std::span<const Interval> box, double limit);

}  // namespace assay::algebra
