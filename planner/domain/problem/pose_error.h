#pragma once

#include "planner/base/interval.h"

namespace assay::domain {

// What is not known exactly about a pose: of the true one about the believed one, metres and
// radians. The whole line: nothing is known.
struct PoseError {
  Interval x, y, z, theta;
};

}  // namespace assay::domain
