#include "planner/mesh_import/meshes/triangle_mesh.h"

#include <fmt/format.h>

#include "planner/base/input_files/input_error.h"

namespace assay::mesh_import {

Vector3 TriangleMesh::Centroid(const Triangle& triangle) const {
  return (Corner(triangle, 0) + Corner(triangle, 1) + Corner(triangle, 2)) / 3;
}

Vector3 TriangleMesh::AreaVector(const Triangle& triangle) const {
  const Vector3& origin = Corner(triangle, 0);
  return (Corner(triangle, 1) - origin).cross(Corner(triangle, 2) - origin) / 2;
}

Eigen::AlignedBox3d TriangleMesh::Bounds() const {
  Eigen::AlignedBox3d bounds;
  for (const Vector3& vertex : vertices) bounds.extend(vertex);
  return bounds;
}

double TriangleMesh::Size() const { return vertices.empty() ? 0 : Bounds().diagonal().norm(); }

// The volume is the sum of the tetrahedra between the triangles and a point. A point near the
// triangles keeps the rounding small.
double TriangleMesh::Volume() const {
  if (vertices.empty()) return 0;
  const Vector3 about = Bounds().center();
  double volume = 0;
  for (const Triangle& triangle : triangles)
    volume += (Corner(triangle, 0) - about).dot(AreaVector(triangle)) / 3;
  return volume;
}

Vector3 TriangleMesh::CenterOfVolume() const {
  const Vector3 about = Bounds().center();
  Vector3 moment = Vector3::Zero();
  double volume = 0;
  for (const Triangle& triangle : triangles) {
    const double own = (Corner(triangle, 0) - about).dot(AreaVector(triangle)) / 3;
    volume += own;
    moment += own * 0.75 * (Centroid(triangle) - about);
  }
  return about + moment / volume;
}

TriangleMesh TriangleMesh::Transformed(const Matrix3& linear) const {
  TriangleMesh transformed = *this;
  for (Vector3& vertex : transformed.vertices) vertex = linear * vertex;
  return transformed;
}

void Refuse(const TriangleMesh& mesh, const Triangle& triangle, const std::string& what,
            const std::string& allowed) {
  throw InputError({mesh.file, triangle.line, 1},
                   fmt::format("triangle {}: {}", triangle.number, what), allowed);
}

TriangleMesh SubMesh(const TriangleMesh& mesh, const std::vector<int>& triangles) {
  TriangleMesh part{.file = mesh.file, .vertices = {}, .triangles = {}};
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const int index : triangles) {
    Triangle triangle = mesh.triangles[static_cast<std::size_t>(index)];
    for (int& corner : triangle.corners) {
      int& kept = number[static_cast<std::size_t>(corner)];
      if (kept < 0) {
        kept = static_cast<int>(part.vertices.size());
        part.vertices.push_back(mesh.vertices[static_cast<std::size_t>(corner)]);
      }
      corner = kept;
    }
    part.triangles.push_back(triangle);
  }
  return part;
}

}  // namespace assay::mesh_import
