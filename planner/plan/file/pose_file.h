#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/base/document/document.h"
#include "planner/geometry/pose.h"

namespace assay::plan {

// Vectors and poses as plan.json holds them: a pose is its columns x, y, z and the position.
// Numbers read back as the very same doubles.
nlohmann::ordered_json VectorToJson(const geometry::Vector3& v);
nlohmann::ordered_json PoseToJson(const geometry::Pose& X);

// Throw InputError with the place: not three numbers; columns that are no axes of a frame.
geometry::Vector3 ReadVector(const Value& value);
geometry::Pose ReadPose(const Value& value);

}  // namespace assay::plan
