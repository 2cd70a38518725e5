#pragma once

#include <vector>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// What monotonicity leaves of a box: the form is as large somewhere in the smaller one as anywhere
// in the first.
struct MonotoneBox {
  Box box;
  Interval range;                  // of the form over it
  std::vector<Interval> gradient;  // over it
};

// Sets each variable whose partial derivative has one sign all over the box to the end where the
// form is largest. Conservative: whatever the others are, the form does not fall on the way to that
// end. The derivatives are better known over the smaller box, so the rest gets another try. Where
// the form may be undefined nothing is set: the end may be a place where it has no value. `held`,
// by variable: those to be left alone; none if empty.
MonotoneBox SetMonotoneVariables(Probe& probe, Box box, const std::vector<bool>& held = {});

}  // namespace assay::algebra
