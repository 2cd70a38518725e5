#include "planner/mesh_import/repair/edge_uses.h"

#include <algorithm>
#include <tuple>

namespace assay::mesh_import {

std::vector<EdgeUse> EdgeUsesOf(const TriangleMesh& mesh) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& corners = mesh.triangles[i].corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = corners[k];
      const int b = corners[(k + 1) % 3];
      uses.push_back(
          {std::min(a, b), std::max(a, b), static_cast<int>(i), corners[(k + 2) % 3], a < b});
    }
  }
  std::ranges::sort(uses, {}, [](const EdgeUse& use) {
    return std::tuple(use.low, use.high, use.triangle, use.is_forward);
  });
  return uses;
}

int Excess(std::span<const EdgeUse> uses) {
  int excess = 0;
  for (const EdgeUse& use : uses) excess += use.is_forward ? 1 : -1;
  return excess;
}

}  // namespace assay::mesh_import
