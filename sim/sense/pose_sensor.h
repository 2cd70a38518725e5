#pragma once

#include <optional>

#include "planner/domain/problem/problem.h"
#include "sim/mujoco/data.h"

namespace assay::sense {

using domain::PartId;
using geometry::Pose;

// Measures the poses of parts. A sensor looks at the simulation as a camera looks at a table, and
// must not use the simulator's truth.
class PoseSensor {
 public:
  PoseSensor() = default;
  PoseSensor(const PoseSensor&) = delete;
  PoseSensor& operator=(const PoseSensor&) = delete;
  virtual ~PoseSensor() = default;

  // Returns the measured pose X_WorldPart of a free part; none if the part cannot be found. The
  // part must rest near its believed pose `believed` and in the same stable pose.
  virtual std::optional<Pose> Measure(const mujoco::Data& data, PartId part,
                                      const Pose& believed) = 0;
};

}  // namespace assay::sense
