#pragma once

#include "planner/base/interval.h"

namespace assay::domain {

// The uncertainty of a pose: the error of the true pose against the believed one, in metres and
// radians. The whole line means that nothing is known.
struct PoseError {
  Interval x, y, z, theta;
};

}  // namespace assay::domain
