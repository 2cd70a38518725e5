#pragma once

#include <array>
#include <string>
#include <vector>

#include "planner/geometry/coordinates.h"


namespace assay::mesh_import {

using geometry::Matrix3;
using geometry::Vector2;
using geometry::Vector3;

struct Triangle {
  std::array<int, 3> corners;  // indices of vertices, counter-clockwise seen from outside
  int number = 0;              // of the triangle in the file, from 1
  int line = 0;                // of the file; 0 in a binary file
};

// A surface of triangles. A mesh is closed if each edge occurs as often in one direction as in the
// other. Lengths are in metres once the units of the file are known (mesh_file.h).
struct TriangleMesh {
  std::string file;  // its name, for messages
  std::vector<Vector3> vertices;
  std::vector<Triangle> triangles;

  const Vector3& Corner(const Triangle& triangle, int k) const {
    return vertices[static_cast<std::size_t>(triangle.corners[static_cast<std::size_t>(k)])];
  }
  Vector3 Centroid(const Triangle& triangle) const;
  // Returns the normal, outward in a mesh that is oriented, with the area as its length.
  Vector3 AreaVector(const Triangle& triangle) const;

  Eigen::AlignedBox3d Bounds() const;
  // Returns the diagonal of the bounding box, to which tolerances are relative.
  double Size() const;
  // Returns the volume inside of a closed mesh. It is negative if the mesh is inside out.
  double Volume() const;
  Vector3 CenterOfVolume() const;  // of a closed mesh whose volume is not 0
  TriangleMesh Transformed(const Matrix3& linear) const;
};

// Throws an InputError at a triangle: "file:line: triangle 12: what; allowed: ...".
[[noreturn]] void Refuse(const TriangleMesh& mesh, const Triangle& triangle,
                         const std::string& what, const std::string& allowed);

// Returns a mesh with some of the triangles of another, and only the vertices that they use.
TriangleMesh SubMesh(const TriangleMesh& mesh, const std::vector<int>& triangles);

}  // namespace assay::mesh_import
