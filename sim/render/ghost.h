#pragma once

#include <vector>

#include "planner/domain/part/part_model.h"
#include "planner/geometry/pose.h"
#include "sim/render/palette.h"

namespace assay::render {

using geometry::Pose;
using geometry::Vector3;

// Where a face ends. An edge between two faces is there twice, once for each.
struct Edge {
  Vector3 from;
  Vector3 to;
  Vector3 normal;  // of the face, outward

  bool FacesTowards(const Vector3& eye) const { return normal.dot(eye - from) > 0; }
};

// A body that is not there, drawn as the edges of those of its faces that look at the camera: it is
// seen as a body, and what is behind it stays in sight.
struct Ghost {
  std::vector<Edge> edges = {};  // world frame, metres
  Colour colour;
};

// The edges of the exposed faces of a part, in its frame.
std::vector<Edge> EdgesOf(const domain::PartModel& model);

// A part as it would look at this pose.
Ghost GhostOf(const domain::PartModel& model, const Pose& X_WorldPart, Colour colour);

}  // namespace assay::render
