#pragma once

#include <span>
#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/coordinates.h"
#include "sim/render/renderer.h"

namespace assay::render {

using geometry::Pose;
using geometry::Vector3;

// A ball that must be in a picture; a point has radius 0. World frame, metres.
struct Ball {
  Vector3 center;
  double radius = 0;
};

// Returns the camera that looks along -`back` and shows all balls. The camera is as near to the
// balls as possible, apart from a margin. `back` is a unit vector that is not vertical. The world's
// z axis points up in the picture. `aspect` is the width of the picture over its height.
FreeCamera Framing(std::span<const Ball> balls, const Vector3& back, double aspect);

// Returns the points that a picture of a part must show: the corners of the part's convex hull,
// world frame.
std::vector<Ball> CornersOf(const domain::PartModel& model, const Pose& X_WorldPart);

}  // namespace assay::render
