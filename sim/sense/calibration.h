#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/domain/problem/problem.h"
#include "planner/domain/reach/reachability.h"
#include "planner/domain/workcell/uncertainty_operations.h"
#include "sim/sense/displacement.h"
#include "sim/sense/pose_sensor.h"

namespace assay::scene {
class Scene;
}

namespace assay::sense {

// All parts of a problem somewhere on the table, one of which a sensor is to find.
struct CalibrationPlacement {
  PartId part = PartId::None();  // to be found
  domain::StablePoseId resting = domain::StablePoseId::None();
  std::vector<Pose> X_WorldPart = {};                // of all parts, by PartId
  Displacement displacement = Displacement::Zero();  // from where the part is believed to be

  Pose Believed() const;
};

// How far the part may be from where it is believed to be when a sensor is calibrated: as the
// errors of scenarios are, with something to spare. The table's height under a part is part of it.
const Displacement& CalibratedDisplacement();  // to each side

// The placement with this number of the problem's sequence with this seed. Stable poses, places and
// yaws are drawn anew for each part: uniform over the table that the sensor looks at, wholly on it,
// with the workcell's gap between parts. Displacements are uniform within the bounds where the
// number is odd, and at their corners where it is even. None if there is no room for all parts.
std::optional<CalibrationPlacement> DrawCalibrationPlacement(const domain::Problem& problem,
                                                             std::uint64_t seed, int number);

// What the sensor measures there: true minus measured. None if it does not find the part.
std::optional<Displacement> MeasuredError(const scene::Scene& scene,
                                          const CalibrationPlacement& placement,
                                          PoseSensor& sensor);

// Whether an error is within what the sensor promises.
bool KeepsPromise(const domain::SensorModel& promise, const Displacement& error);

}  // namespace assay::sense
