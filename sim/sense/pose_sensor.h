#pragma once

#include <optional>

#include "planner/domain/problem/problem.h"
#include "sim/mujoco/data.h"

namespace assay::sense {

using domain::PartId;
using geometry::Pose;

// Measures where parts are. A real sensor looks at the simulation as a camera looks at a table; it
// is never told the truth.
class PoseSensor {
 public:
  PoseSensor() = default;
  PoseSensor(const PoseSensor&) = delete;
  PoseSensor& operator=(const PoseSensor&) = delete;
  virtual ~PoseSensor() = default;

  // X_WorldPart, of a part that lies free and is believed to be at `believed`: it rests in the same
  // stable pose, not far from there. None if the part cannot be found.
  virtual std::optional<Pose> Measure(const mujoco::Data& data, PartId part,
                                      const Pose& believed) = 0;
};

}  // namespace assay::sense
