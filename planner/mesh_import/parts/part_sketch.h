#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/mesh_import/parts/body_shape.h"

namespace assay::mesh_import {

// A part as it will be written, in metres. Its frame is that of the files, or is turned so that the
// largest body is along its axes.
struct SketchSolid {
  std::string name;
  Matrix3 R_PartLocal = Matrix3::Identity();  // of the post: its z is the axis of extrusion
  std::optional<Post> post;                   // or else the pieces
  std::vector<geometry::ConvexHull> pieces;   // in the frame of the part

  // Returns the corners of the solid in the frame of the part, without its chamfers. A circle has
  // `sides` corners.
  std::vector<Vector3> Corners(int sides) const;
};

struct SketchPocket {
  std::string name;
  int solid = 0;  // index of the solid that it is cut from, and whose R_PartLocal it has
  StackPocket pocket;
};

struct SketchFeature {
  enum class Kind { kFace, kHole, kShaft };
  Kind kind = Kind::kFace;
  std::string of;                        // name of a solid or a pocket
  Vector3 direction = Vector3::UnitZ();  // normal or axis, in the frame of the part
  std::string what;
  double chamfer = 0;
};

struct PartSketch {
  std::string name;
  Matrix3 R_FilePart = Matrix3::Identity();
  std::vector<SketchSolid> solids;
  std::vector<SketchPocket> pockets;
  std::vector<SketchFeature> features;  // numbered from 1
  double size = 0;                      // the diagonal of its bounding box

  bool CanBeMated() const;  // whether it has a hole or a shaft
  // Returns whether a point is in a solid and in no pocket that is cut from it.
  bool Contains(const Vector3& p) const;
};

// Puts the shapes of a part's bodies together and names them. The first body is the largest.
PartSketch SketchOf(const std::string& name, const std::vector<BodyShape>& bodies);

// Returns the axis, x, y or z, along which a frame's z lies if the frame only renames the axes in
// their order; none if it turns them.
std::optional<char> AxisOf(const Matrix3& R_PartLocal);

}  // namespace assay::mesh_import
