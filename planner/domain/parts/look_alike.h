#pragma once

#include "planner/domain/problem/problem.h"

namespace assay::domain {

// Returns whether a part in one pose can look to the sensor as it does in the other. That is so if
// some displacement and turn about the world's z bring its boxes to the boxes of the other pose,
// directly or by a symmetry of the part. The displacement and the turn must be so small that the
// part's errors in both poses and the sensor's promise together can explain them. Coordinates that
// the sensor does not measure are open.
bool LookAlike(const Part& part, const Pose& X_WorldA, const Pose& X_WorldB,
               const SensorModel& sensor);

}  // namespace assay::domain
