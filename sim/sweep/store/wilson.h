#pragma once

#include "planner/base/interval.h"

namespace assay::sweep {

// In which the true rate lies with 95 % confidence, after so many successes in so many trials
// (Wilson 1927): unlike the usual one it is right for few trials and for rates near 0 and 1.
// Without trials: 0 to 1.
Interval WilsonInterval(int successes, int trials);

}  // namespace assay::sweep
