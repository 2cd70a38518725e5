#pragma once

#include <optional>

#include "planner/mesh_import/parts/imported_part.h"

namespace assay::mesh_import {

// A way in which a part can lie on a table.
struct RestingPose {
  Vector3 down;  // outward normal of the face of its hull that touches the table, unit, part frame
  double tilt = 0;  // by which it can be tilted before it falls, radians
};

// Returns the poses in which a part stands even if it is tilted by 2 degrees, the safest first. The
// density is the same everywhere.
std::vector<RestingPose> RestingPosesOf(const ImportedPart& part);

// Returns the extents of a part along the axes of its frame, in metres.
Vector3 ExtentsOf(const ImportedPart& part);

// Returns the pose of a part on the table z = 0, at x and y, with a direction down.
geometry::Pose OnTable(const ImportedPart& part, const Vector3& down, const Vector2& at);

}  // namespace assay::mesh_import
