#pragma once

#include "planner/base/input_files/document.h"
#include "planner/domain/problem/pose_error.h"
#include "planner/domain/units/units.h"

namespace assay::domain {

// Reads `{x: , y: , z: , theta: }`, each a half-width or [low, high]. Coordinates that the map
// leaves out stay as they are in `otherwise`. Throws InputError for other keys, negative
// half-widths, reversed ends, and intervals without 0: the believed pose is always possible.
PoseError ReadPoseError(const Value& map, const Units& units, const PoseError& otherwise);

}  // namespace assay::domain
