#pragma once

#include <vector>

#include "planner/algebra/bounds/probe.h"

namespace assay::algebra {

// The smaller box that monotonicity leaves of a box. The greatest value of the form in the first
// box occurs in the smaller box, too.
struct MonotoneBox {
  Box box;
  Interval range;                  // the range of the form over `box`
  std::vector<Interval> gradient;  // the ranges of its derivatives over `box`
};

// Sets each variable whose partial derivative has one sign all over the box to the end at which the
// form is largest. This is conservative: for any values of the other variables, the form does not
// fall on the way to that end. Derivatives are tighter over a smaller box, so the remaining
// variables are tried again. Where the form may be undefined nothing is set, because it might have
// no value at the end. `held`, indexed by variable, marks the variables to leave alone; an empty
// list marks none.
MonotoneBox SetMonotoneVariables(Probe& probe, Box box, const std::vector<bool>& held = {});

}  // namespace assay::algebra
