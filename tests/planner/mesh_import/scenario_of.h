#pragma once

#include <fmt/format.h>

#include <string>

#include "planner/mesh_import/parts/mated_scenario.h"

namespace assay::mesh_import {

// Returns the scenario of a pair. In place of the poses, it has the direction that should point
// down as nearly as possible, and the place of the part, in metres.
inline std::string ScenarioOf(const MatedPair& pair) {
  const auto pose = [](const ImportedPart&, const Vector3& down, const Vector2& at) {
    return fmt::format("{{down: [{:.6g}, {:.6g}, {:.6g}], at: [{:.6g}, {:.6g}]}}", down.x() + 0.0,
                       down.y() + 0.0, down.z() + 0.0, at.x(), at.y());
  };
  return ScenarioText(pair, pose);
}

}  // namespace assay::mesh_import
