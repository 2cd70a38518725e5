#include "planner/mesh_import/decomposition/concave_planes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "planner/mesh_import/repair/edge_uses.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kMostConcavePlanes = 8;
constexpr double kSameNormal = 0.02;   // radians
constexpr double kSameHeight = 0.005;  // share of the size
constexpr double kConcave = 0.02;      // sine of the angle at a concave edge

struct WeightedPlane {
  CutPlane plane;
  double length = 0;  // of concave edges in it
};

}  // namespace

std::vector<CutPlane> ConcavePlanesOf(const TriangleMesh& mesh) {
  const double size = mesh.Size();
  std::map<std::array<long, 4>, WeightedPlane> found;
  const auto add = [&](int triangle, double length) {
    const Vector3 area = mesh.AreaVector(mesh.triangles[static_cast<std::size_t>(triangle)]);
    if (area.norm() == 0) return;
    Vector3 normal = area.normalized();
    if (normal.x() + 0.01 * normal.y() + 0.0001 * normal.z() < 0) normal = -normal;
    const double height =
        normal.dot(mesh.Corner(mesh.triangles[static_cast<std::size_t>(triangle)], 0));
    const auto index = [](double value, double step) { return std::lround(value / step); };
    WeightedPlane& plane =
        found[{index(normal.x(), kSameNormal), index(normal.y(), kSameNormal),
               index(normal.z(), kSameNormal), index(height, kSameHeight * size)}];
    if (plane.length == 0) plane.plane = {.normal = normal, .height = height};
    plane.length += length;
  };
  const std::vector<EdgeUse> uses = EdgeUsesOf(mesh);
  ForEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2) return;
    const auto point = [&](int i) -> const Vector3& {
      return mesh.vertices[static_cast<std::size_t>(i)];
    };
    const Vector3 normal =
        mesh.AreaVector(mesh.triangles[static_cast<std::size_t>(edge[0].triangle)]).normalized();
    const Vector3 to = point(edge[1].opposite) - point(edge[0].low);
    if (normal.dot(to) <= kConcave * to.norm()) return;
    const double length = (point(edge[0].high) - point(edge[0].low)).norm();
    for (const EdgeUse& use : edge) add(use.triangle, length);
  });
  std::vector<WeightedPlane> planes;
  for (const auto& [key, plane] : found) planes.push_back(plane);
  std::ranges::stable_sort(planes, std::ranges::greater(), &WeightedPlane::length);
  std::vector<CutPlane> chosen;
  for (const WeightedPlane& plane : planes) {
    if (chosen.size() < kMostConcavePlanes) chosen.push_back(plane.plane);
  }
  const Vector3 middle = mesh.Bounds().center();
  for (int axis = 0; axis < 3; ++axis)
    chosen.push_back({.normal = Vector3::Unit(axis), .height = middle[axis]});
  return chosen;
}

}  // namespace assay::mesh_import
