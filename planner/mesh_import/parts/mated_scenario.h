#pragma once

#include <functional>
#include <string>

#include "planner/mesh_import/parts/mated_pair.h"

namespace assay::mesh_import {

// Returns the text of the pose in which a part starts: on the table at x and y, and as nearly as it
// can with this direction of its frame pointing down.
using StartingPose =
    std::function<std::string(const ImportedPart& part, const Vector3& down, const Vector2& at)>;

// Returns a scenario in which the parts lie on the table and are assembled. The fixed part lies
// with its hole up if it can rest so, and the held part stands as nearly as it can as it is mated.
std::string ScenarioText(const MatedPair& pair, const StartingPose& starting_pose);

}  // namespace assay::mesh_import
