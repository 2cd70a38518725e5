#include "planner/mesh_import/repair/weld.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace assay::mesh_import {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t index : cell)
      hash = (hash ^ static_cast<std::uint64_t>(index)) * 0x9e3779b97f4a7c15U + (hash >> 29);
    return hash ^ hash >> 32;
  }
};

// The vertices that are kept, by the cubes of a grid.
class VertexGrid {
 public:
  VertexGrid(const Vector3& origin, double tolerance) : origin_(origin), tolerance_(tolerance) {}

  // Returns the number of a kept vertex within the tolerance, or keeps this one.
  int Find(const Vector3& p, std::vector<Vector3>& kept) {
    const Cell cell = CellOf(p);
    for (int i = 0; i < 27; ++i) {
      // The vertex's own cube is looked up first.
      constexpr std::array<int, 3> kSteps = {0, -1, 1};
      const auto step = [&](int digit) { return kSteps[static_cast<std::size_t>(digit % 3)]; };
      const auto found =
          cells_.find({cell[0] + step(i), cell[1] + step(i / 3), cell[2] + step(i / 9)});
      if (found == cells_.end()) continue;
      const int near = found->second;
      if ((kept[static_cast<std::size_t>(near)] - p).norm() <= tolerance_) return near;
    }
    const int fresh = static_cast<int>(kept.size());
    kept.push_back(p);
    cells_.try_emplace(cell, fresh);
    return fresh;
  }

 private:
  Cell CellOf(const Vector3& p) const {
    const auto index = [&](int axis) {
      return static_cast<std::int64_t>(std::floor((p[axis] - origin_[axis]) / tolerance_));
    };
    return {index(0), index(1), index(2)};
  }

  const Vector3 origin_;
  const double tolerance_;
  std::unordered_map<Cell, int, CellHash> cells_;
};

}  // namespace

int Weld(TriangleMesh& mesh, double tolerance) {
  if (mesh.vertices.empty() || !(tolerance > 0)) return 0;
  VertexGrid grid(mesh.Bounds().min(), tolerance);
  std::vector<Vector3> kept;
  std::vector<int> number;
  for (const Vector3& vertex : mesh.vertices) number.push_back(grid.Find(vertex, kept));
  mesh.vertices = std::move(kept);
  for (Triangle& triangle : mesh.triangles) {
    for (int& corner : triangle.corners) corner = number[static_cast<std::size_t>(corner)];
  }
  return static_cast<int>(std::erase_if(mesh.triangles, [](const Triangle& triangle) {
    const auto& [a, b, c] = triangle.corners;
    return a == b || b == c || c == a;
  }));
}

}  // namespace assay::mesh_import
