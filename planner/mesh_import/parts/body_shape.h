#pragma once

#include <string>
#include <vector>

#include "planner/geometry/hull.h"
#include "planner/mesh_import/meshes/triangle_mesh.h"
#include "planner/mesh_import/sections/stack.h"

namespace assay::mesh_import {

// A stack may be so far from its mesh, as a share of the size of the body.
inline constexpr double kMostDistance = 0.01;

// What one closed body is: a stack of extrusions, or convex pieces if it is none.
struct BodyShape {
  bool is_stack = false;
  Matrix3 R_FileLocal = Matrix3::Identity();  // of the stack: its z is the axis of extrusion
  Stack stack = {};
  std::vector<geometry::ConvexHull> pieces = {};  // in the frame of the file, if it is no stack
  double distance = 0;                            // between the surfaces of body and shape, metres
  double volume_share = 0;                        // by which the shape is greater
  int triangles = 0;                              // of the mesh
  double volume = 0;                              // of the mesh, cubic metres
  Vector3 centroid = Vector3::Zero();             // of the mesh, in the frame of the file
  std::string reason = {};                        // why it is no stack
};

// Returns the shape of a body. If the body is a stack along several axes, the stack with the fewest
// solids and pockets is taken, and among equal ones the stack that is longest along its axis. Each
// stack is within kMostDistance of the mesh. A body that is no stack is cut by planes through
// concave edges. If all parts are stacks, they are the result. Otherwise the result is one shape of
// convex pieces. Throws InputError for a body that is no stack and has too many triangles to be
// decomposed.
std::vector<BodyShape> ShapesOf(const TriangleMesh& body);

}  // namespace assay::mesh_import
