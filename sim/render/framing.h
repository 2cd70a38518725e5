#pragma once

#include <span>
#include <vector>

#include "planner/domain/part/part_model.h"
#include "planner/geometry/pose.h"
#include "sim/render/renderer.h"

namespace assay::render {

using geometry::Pose;
using geometry::Vector3;

// What is to be in a picture; a point has radius 0. World frame, metres.
struct Ball {
  Vector3 center;
  double radius = 0;
};

// The camera that looks along -`back` (unit, not vertical) and has all balls in its picture, as
// near to them as that allows, but for a margin; z is up in the picture. `aspect`: width over
// height of the picture.
FreeCamera Framing(std::span<const Ball> balls, const Vector3& back, double aspect);

// The corners of a part's hull.
std::vector<Ball> CornersOf(const domain::PartModel& model, const Pose& X_WorldPart);

}  // namespace assay::render
