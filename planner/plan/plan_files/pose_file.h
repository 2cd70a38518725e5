#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/base/input_files/document.h"
#include "planner/geometry/coordinates.h"

namespace assay::plan {

// Return vectors and poses as plan.json holds them. A pose is its columns x, y, z and the position.
// Numbers read back as exactly the same doubles.
nlohmann::ordered_json VectorToJson(const geometry::Vector3& v);
nlohmann::ordered_json PoseToJson(const geometry::Pose& X);

// Read vectors and poses. They throw InputError with the place of the error: not three numbers, or
// columns that are no axes of a frame.
geometry::Vector3 ReadVector(const Value& value);
geometry::Pose ReadPose(const Value& value);

}  // namespace assay::plan
