#include "planner/mesh_import/repair/shells.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include "planner/mesh_import/repair/edge_uses.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kMostTrianglesAtEdge = 100;

// Sets of triangles that are joined one by one.
class JoinedTriangles {
 public:
  explicit JoinedTriangles(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int RootOf(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) {
      int& parent = parent_[static_cast<std::size_t>(i)];
      parent = parent_[static_cast<std::size_t>(parent)];
      i = parent;
    }
    return i;
  }
  void Join(int a, int b) { parent_[static_cast<std::size_t>(RootOf(a))] = RootOf(b); }

 private:
  std::vector<int> parent_;
};

// Joins each triangle that runs forward along an edge with the first one that runs backward, seen
// by a turn about the edge through the solid.
void JoinAcrossSolid(const TriangleMesh& mesh, std::span<const EdgeUse> edge,
                     JoinedTriangles& joined) {
  const auto point = [&](int i) -> const Vector3& {
    return mesh.vertices[static_cast<std::size_t>(i)];
  };
  const Vector3 along = (point(edge[0].high) - point(edge[0].low)).normalized();
  const auto away = [&](const EdgeUse& use) -> Vector3 {
    const Vector3 to = point(use.opposite) - point(use.low);
    return to - along * along.dot(to);
  };
  for (const EdgeUse& forward : edge) {
    if (!forward.is_forward) continue;
    const Vector3 x = away(forward);
    const Vector3 inward = -along.cross(x);
    const EdgeUse* first = nullptr;
    double least = 0;
    for (const EdgeUse& backward : edge) {
      if (backward.is_forward) continue;
      const Vector3 d = away(backward);
      double angle = std::atan2(d.dot(inward), d.dot(x));
      if (angle <= 1e-9) angle += 2 * std::numbers::pi;
      if (first != nullptr && angle >= least) continue;
      first = &backward;
      least = angle;
    }
    if (first != nullptr) joined.Join(forward.triangle, first->triangle);
  }
}

}  // namespace

std::vector<TriangleMesh> ShellsOf(const TriangleMesh& mesh) {
  JoinedTriangles joined(mesh.triangles.size());
  const std::vector<EdgeUse> uses = EdgeUsesOf(mesh);
  ForEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() > kMostTrianglesAtEdge) {
      Refuse(mesh, mesh.triangles[static_cast<std::size_t>(edge.front().triangle)],
             fmt::format("an edge of it has {} triangles", edge.size()),
             fmt::format("at most {}", kMostTrianglesAtEdge));
    }
    JoinAcrossSolid(mesh, edge, joined);
  });
  std::map<int, std::size_t> place;
  std::vector<std::vector<int>> shells;
  for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) {
    const auto [found, is_new] = place.try_emplace(joined.RootOf(i), shells.size());
    if (is_new) shells.emplace_back();
    shells[found->second].push_back(i);
  }
  std::vector<TriangleMesh> parts;
  for (const std::vector<int>& shell : shells) parts.push_back(SubMesh(mesh, shell));
  return parts;
}

}  // namespace assay::mesh_import
