#pragma once

#include <span>
#include <vector>

#include "planner/domain/part/part_model.h"
#include "planner/geometry/box.h"
#include "planner/geometry/polygon.h"
#include "sim/sense/view.h"

namespace assay::sense {

// The part's boxes in the world frame.
std::vector<geometry::Box> BoxesAt(const domain::PartModel& model, const Pose& X_WorldPart);

// The pictures of some boxes (world frame): their union is the picture of all of them.
std::vector<geometry::Polygon> Shadows(std::span<const geometry::Box> boxes, const View& view);

// A point of a contour.
struct ContourPoint {
  Vector3 p_World;  // on an edge of a box
  Vector2 pixel;    // its picture
  Vector2 normal;   // of the contour there, unit, pixels, outward
};

// Points of the contour of the union, inner contours around through holes included, about every
// `spacing` pixels. Left out is what has no clean edge: the ends of straight pieces, and pieces
// with another contour within `kContourReach` pixels on the same normal.
inline constexpr double kContourReach = 2.5;
std::vector<ContourPoint> Contour(std::span<const geometry::Box> boxes, const View& view,
                                  double spacing);

}  // namespace assay::sense
