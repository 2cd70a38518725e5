#include "planner/mesh_import/repair/orientation.h"

#include <utility>

#include "planner/mesh_import/repair/edge_uses.h"

namespace assay::mesh_import {
namespace {

struct Neighbor {
  int triangle = 0;
  bool agrees = true;  // whether both are oriented alike
};

std::vector<std::vector<Neighbor>> NeighborsIn(const TriangleMesh& mesh) {
  std::vector<std::vector<Neighbor>> neighbors(mesh.triangles.size());
  const std::vector<EdgeUse> uses = EdgeUsesOf(mesh);
  ForEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() != 2) return;
    const bool agrees = edge[0].is_forward != edge[1].is_forward;
    neighbors[static_cast<std::size_t>(edge[0].triangle)].push_back({edge[1].triangle, agrees});
    neighbors[static_cast<std::size_t>(edge[1].triangle)].push_back({edge[0].triangle, agrees});
  });
  return neighbors;
}

}  // namespace

int OrientConsistently(TriangleMesh& mesh) {
  enum class Side : char { kUnknown, kKept, kTurned };
  const std::vector<std::vector<Neighbor>> neighbors = NeighborsIn(mesh);
  std::vector<Side> sides(mesh.triangles.size(), Side::kUnknown);
  int turned = 0;
  for (std::size_t start = 0; start < sides.size(); ++start) {
    if (sides[start] != Side::kUnknown) continue;
    sides[start] = Side::kKept;
    std::vector<std::size_t> patch = {start};
    int turned_here = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (const Neighbor& neighbor : neighbors[patch[i]]) {
        const auto other = static_cast<std::size_t>(neighbor.triangle);
        const bool is_kept = (sides[patch[i]] == Side::kKept) == neighbor.agrees;
        const Side wanted = is_kept ? Side::kKept : Side::kTurned;
        if (sides[other] == Side::kUnknown) {
          sides[other] = wanted;
          turned_here += !is_kept;
          patch.push_back(other);
        } else if (sides[other] != wanted) {
          Refuse(mesh, mesh.triangles[other], "the surface has only one side here",
                 "a surface that separates inside and outside");
        }
      }
    }
    // The orientation of most triangles of the patch is kept.
    const bool keeps_most = 2 * turned_here <= static_cast<int>(patch.size());
    turned += keeps_most ? turned_here : static_cast<int>(patch.size()) - turned_here;
    for (const std::size_t i : patch) {
      if ((sides[i] == Side::kTurned) == keeps_most)
        std::swap(mesh.triangles[i].corners[1], mesh.triangles[i].corners[2]);
    }
  }
  return turned;
}

}  // namespace assay::mesh_import
