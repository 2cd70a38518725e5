#pragma once

#include "planner/domain/problem/problem.h"

namespace assay::domain {

// A part somewhere in the world, for tests against hand and fingers.
struct PlacedPart {
  PartId part;
  Pose X_WorldPart;
};

}  // namespace assay::domain
