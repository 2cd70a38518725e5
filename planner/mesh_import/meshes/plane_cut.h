#pragma once

#include <utility>
#include <vector>

#include "planner/geometry/solids/triangulation.h"
#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Cuts of closed meshes by a plane (unit normal . p == height). Vertices within `tolerance` of the
// plane count as above it, at no height. The curves of a cut are therefore closed, whatever lies in
// the plane.

struct CutPlane {
  Vector3 normal;
  double height = 0;
  double tolerance = 0;
};

// The section of a mesh: loops that keep the inside of the mesh to their left, seen from where the
// normal points.
struct Section {
  std::vector<Vector3> points;
  std::vector<geometry::Loop> loops;  // indices of points
};
Section SectionOf(const TriangleMesh& mesh, const CutPlane& plane);

// Returns the parts of a mesh below and above a plane, both closed by triangles in the plane. A
// part may be empty.
std::pair<TriangleMesh, TriangleMesh> CutBy(const TriangleMesh& mesh, const CutPlane& plane);

}  // namespace assay::mesh_import
