#pragma once

#include "planner/domain/problem/problem.h"

namespace assay::domain {

// Whether a part in one pose can look to the sensor as it does in the other: some displacement and
// turn about the world's z make its boxes those of the other pose (by themselves, or by a symmetry
// of the part), and they are within what the part's error in both poses and the sensor's promise
// leave open. What the sensor does not measure is open.
bool LookAlike(const Part& part, const Pose& X_WorldA, const Pose& X_WorldB,
               const SensorModel& sensor);

}  // namespace assay::domain
