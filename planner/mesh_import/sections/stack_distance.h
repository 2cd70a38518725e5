#pragma once

#include "planner/mesh_import/meshes/triangle_mesh.h"
#include "planner/mesh_import/sections/stack.h"

namespace assay::mesh_import {

// How far a stack is from the mesh that it was made from.
struct StackDistance {
  double distance = 0;      // greatest distance of a point of either surface from the other, metres
  int triangle = 0;         // index of the triangle of the mesh where it is
  double volume_share = 0;  // of the mesh's volume, by which the stack is greater
};

// Measures at the corners and the middles of the mesh's triangles, and at points on the walls of
// the stack. Round posts are measured as true circles, and with the chamfers that the stack states.
StackDistance DistanceBetween(const TriangleMesh& mesh, const Stack& stack, double tolerance);

}  // namespace assay::mesh_import
