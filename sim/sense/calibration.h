#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/domain/reachability/reachability.h"
#include "planner/domain/workcell/uncertainty_operations.h"
#include "sim/sense/displacement.h"
#include "sim/sense/pose_sensor.h"

namespace assay::scene {
class Scene;
}

namespace assay::sense {

// Poses of all parts of a problem on the table, and the part that a sensor must find.
struct CalibrationPlacement {
  PartId part = PartId::None();  // the part that the sensor must find
  domain::StablePoseId resting = domain::StablePoseId::None();
  std::vector<Pose> X_WorldPart = {};                // true poses of all parts, by PartId
  Displacement displacement = Displacement::Zero();  // true pose minus believed pose

  // Returns the believed pose of `part`.
  Pose Believed() const;
};

// Returns the greatest displacement, to each side, of a part from its believed pose when a sensor
// is calibrated. It is somewhat larger than the errors of scenarios. It includes the error of the
// table's height under the part.
const Displacement& CalibratedDisplacement();

// Draws the placement with this number in the problem's sequence for this seed. Stable pose, place
// and yaw are drawn for each part, uniformly over the table that the sensor looks at. Parts lie
// wholly on the table, with the workcell's gap between them. For odd numbers displacements are
// uniform within their bounds; for even numbers they are at the corners of the bounds. Returns none
// if there is no room for all parts.
std::optional<CalibrationPlacement> DrawCalibrationPlacement(const domain::Problem& problem,
                                                             std::uint64_t seed, int number);

// Returns the sensor's error for the placement, the true pose minus the measured one. Returns none
// if the sensor does not find the part.
std::optional<Displacement> MeasuredError(const scene::Scene& scene,
                                          const CalibrationPlacement& placement,
                                          PoseSensor& sensor);

// Returns whether the error is within the error bounds that the sensor promises.
bool KeepsPromise(const domain::SensorModel& promise, const Displacement& error);

}  // namespace assay::sense
