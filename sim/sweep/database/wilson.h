#pragma once

#include "planner/base/interval.h"

namespace assay::sweep {

// Returns Wilson's interval (1927), which contains the true rate of success with 95 % confidence.
// Unlike the usual interval it is right for few trials and for rates near 0 and 1. Without trials
// it is 0 to 1.
Interval WilsonInterval(int successes, int trials);

}  // namespace assay::sweep
