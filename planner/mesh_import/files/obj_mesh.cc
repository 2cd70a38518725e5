#include "planner/mesh_import/files/obj_mesh.h"

#include <fmt/format.h>

#include <span>

#include "planner/base/input_files/input_error.h"
#include "planner/geometry/files/obj.h"
#include "planner/geometry/solids/triangulation.h"
#include "planner/mesh_import/files/stl.h"

namespace assay::mesh_import {
namespace {

// Returns triangles that fill a face with these corners, as places among the corners.
std::vector<std::array<int, 3>> TrianglesOf(std::span<const int> corners,
                                            std::span<const Vector3> vertices) {
  if (corners.size() == 3) return {{0, 1, 2}};
  const auto point = [&](std::size_t i) -> const Vector3& {
    return vertices[static_cast<std::size_t>(corners[i])];
  };
  Vector3 normal = Vector3::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i)
    normal += (point(i - 1) - point(0)).cross(point(i) - point(0));
  const Vector3 u = normal.norm() > 0 ? normal.unitOrthogonal() : Vector3::UnitX();
  const Vector3 v = normal.normalized().cross(u);
  std::vector<Vector2> flat;
  geometry::Loop loop;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    flat.emplace_back(u.dot(point(i)), v.dot(point(i)));
    loop.push_back(static_cast<int>(i));
  }
  return geometry::Triangulated(flat, {loop});
}

}  // namespace

TriangleMesh ReadObjMesh(std::string_view text, const std::string& file) {
  geometry::ObjText obj = geometry::ReadObj(text, file);
  TriangleMesh mesh{.file = file, .vertices = std::move(obj.vertices), .triangles = {}};
  int number = 0;
  for (const geometry::ObjFace& face : obj.faces) {
    const std::span corners = std::span<const int>(obj.corners).subspan(face.first, face.count);
    ++number;
    for (const auto& [a, b, c] : TrianglesOf(corners, mesh.vertices)) {
      const auto corner = [&](int i) { return corners[static_cast<std::size_t>(i)]; };
      mesh.triangles.push_back(
          {.corners = {corner(a), corner(b), corner(c)}, .number = number, .line = face.line});
    }
    if (mesh.triangles.size() > kMostTriangles) {
      throw InputError({file, face.line}, "there are too many triangles",
                       fmt::format("at most {}", kMostTriangles));
    }
  }
  return mesh;
}

}  // namespace assay::mesh_import
