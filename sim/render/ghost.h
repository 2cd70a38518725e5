#pragma once

#include <vector>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/coordinates.h"
#include "sim/render/palette.h"

namespace assay::render {

using geometry::Pose;
using geometry::Vector3;

// An edge of a face. An edge between two faces occurs twice, once for each face.
struct Edge {
  Vector3 from;
  Vector3 to;
  Vector3 normal;  // outward normal of the face

  bool FacesTowards(const Vector3& eye) const { return normal.dot(eye - from) > 0; }
};

// The drawing of a body at a pose that need not be its true pose. The edges of its faces that face
// the camera are drawn, so that it looks like a body and does not hide anything.
struct Ghost {
  std::vector<Edge> edges = {};  // world frame, metres
  Colour colour;
};

// Returns the edges of the exposed faces of a part, which pictures draw, in the frame of the part.
std::vector<Edge> EdgesOf(const domain::PartModel& model);

// Returns the ghost with which pictures show a part at this pose.
Ghost GhostOf(const domain::PartModel& model, const Pose& X_WorldPart, Colour colour);

}  // namespace assay::render
