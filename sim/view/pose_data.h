#pragma once

#include <nlohmann/json_fwd.hpp>

#include "planner/geometry/coordinates.h"

namespace assay::view {

using geometry::Pose;
using geometry::Vector3;

// Return [x, y, z], and [x, y, z, w, i, j, k] with the quaternion w + i, j, k. Numbers are rounded
// to a micrometre, or to a millionth.
nlohmann::ordered_json ToJson(const Vector3& vector);
nlohmann::ordered_json ToJson(const Pose& pose);

}  // namespace assay::view
