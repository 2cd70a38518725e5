#include "planner/mesh_import/repair/openings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "planner/geometry/solids/triangulation.h"
#include "planner/mesh_import/repair/edge_uses.h"

namespace assay::mesh_import {
namespace {

using geometry::Loop;

constexpr std::size_t kMostOpenings = 2000;
constexpr std::size_t kMostRims = 20'000;

// An edge that the closing triangles must run along.
struct Rim {
  int end = 0;
  int triangle = 0;  // beside it
};
using Rims = std::multimap<int, Rim>;  // by the vertex where the edge begins

Rims RimsOf(const TriangleMesh& mesh) {
  Rims rims;
  const std::vector<EdgeUse> uses = EdgeUsesOf(mesh);
  ForEachEdge(uses, [&](std::span<const EdgeUse> edge) {
    const int excess = Excess(edge);
    for (int i = 0; i < std::abs(excess); ++i) {
      const EdgeUse& use = edge.front();
      if (excess > 0) {
        rims.emplace(use.high, Rim{use.low, use.triangle});
      } else {
        rims.emplace(use.low, Rim{use.high, use.triangle});
      }
    }
  });
  return rims;
}

struct Opening {
  Loop loop;
  int triangle = 0;                  // beside it
  Vector3 normal = Vector3::Zero();  // with the enclosed area as its length
  Vector3 middle = Vector3::Zero();
};

Opening OpeningOf(const TriangleMesh& mesh, Loop loop, int triangle) {
  Opening opening{.loop = std::move(loop), .triangle = triangle};
  const auto point = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[static_cast<std::size_t>(opening.loop[i % opening.loop.size()])];
  };
  for (std::size_t i = 0; i < opening.loop.size(); ++i)
    opening.middle += point(i) / static_cast<double>(opening.loop.size());
  for (std::size_t i = 0; i < opening.loop.size(); ++i)
    opening.normal += (point(i) - opening.middle).cross(point(i + 1) - opening.middle) / 2;
  return opening;
}

// Follows the rims around openings. Where several rims begin at a vertex, the one that turns back
// most is next, so that openings that touch in a vertex stay apart.
class RimWalk {
 public:
  explicit RimWalk(const TriangleMesh& mesh) : mesh_(mesh), rims_(RimsOf(mesh)) {}

  std::vector<Opening> Openings() {
    if (rims_.size() > kMostRims) {
      Refuse(mesh_, mesh_.triangles[static_cast<std::size_t>(rims_.begin()->second.triangle)],
             fmt::format("the surface is open along {} edges, of which this triangle has one",
                         rims_.size()),
             "a closed surface");
    }
    while (!rims_.empty()) Walk();
    return std::move(openings_);
  }

 private:
  const Vector3& Point(int vertex) const {
    return mesh_.vertices[static_cast<std::size_t>(vertex)];
  }

  void Walk() {
    Loop path = {rims_.begin()->first};
    while (!path.empty()) {
      const Rims::iterator next = NextAfter(path);
      if (next == rims_.end()) {
        if (path.size() == 1) return;
        Refuse(mesh_, mesh_.triangles[static_cast<std::size_t>(beside_)],
               "the surface ends here, but not along a closed curve", "a closed surface");
      }
      const Rim rim = next->second;
      beside_ = rim.triangle;
      rims_.erase(next);
      const auto met = std::ranges::find(path, rim.end);
      if (met == path.end()) {
        path.push_back(rim.end);
        continue;
      }
      openings_.push_back(OpeningOf(mesh_, Loop(met, path.end()), rim.triangle));
      if (openings_.size() > kMostOpenings) {
        Refuse(mesh_, mesh_.triangles[static_cast<std::size_t>(beside_)],
               fmt::format("this is beside one of more than {} openings", kMostOpenings),
               "a closed surface");
      }
      path.erase(met + 1, path.end());
    }
  }

  Rims::iterator NextAfter(const Loop& path) {
    const auto [begin, end] = rims_.equal_range(path.back());
    if (begin == end) return rims_.end();
    if (path.size() < 2) return begin;
    const Vector3 back = (Point(path[path.size() - 2]) - Point(path.back())).normalized();
    const auto turns_back = [&](const auto& entry) {
      return back.dot((Point(entry.second.end) - Point(path.back())).normalized());
    };
    auto best = begin;
    for (auto rim = begin; rim != end; ++rim) {
      if (turns_back(*rim) > turns_back(*best) + 1e-9) best = rim;
    }
    return best;
  }

  const TriangleMesh& mesh_;
  Rims rims_;
  int beside_ = 0;
  std::vector<Opening> openings_;
};

// Returns how far a vertex of an opening is from another opening's plane.
double OffPlane(const TriangleMesh& mesh, const Opening& opening, const Opening& plane) {
  const Vector3 normal = plane.normal.normalized();
  double off = 0;
  for (const int vertex : opening.loop)
    off = std::max(
        off, std::abs(normal.dot(mesh.vertices[static_cast<std::size_t>(vertex)] - plane.middle)));
  return off;
}

// Returns the length of an opening's outline.
double Girth(const TriangleMesh& mesh, const Loop& loop) {
  double length = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    length += (mesh.vertices[static_cast<std::size_t>(loop[(i + 1) % loop.size()])] -
               mesh.vertices[static_cast<std::size_t>(loop[i])])
                  .norm();
  return length;
}

bool IsSlit(const TriangleMesh& mesh, const Opening& opening, double tolerance) {
  return opening.normal.norm() <= tolerance * Girth(mesh, opening.loop) / 2;
}

void Fill(TriangleMesh& mesh, const std::vector<const Opening*>& together) {
  const Vector3 normal = together.front()->normal.normalized();
  const Vector3 u = normal.norm() > 0 ? normal.unitOrthogonal() : Vector3::UnitX();
  const Vector3 v = normal.cross(u);
  std::vector<int> vertex;
  std::vector<Vector2> flat;
  std::vector<Loop> loops;
  for (const Opening* opening : together) {
    Loop loop;
    for (const int i : opening->loop) {
      loop.push_back(static_cast<int>(vertex.size()));
      vertex.push_back(i);
      const Vector3& p = mesh.vertices[static_cast<std::size_t>(i)];
      flat.emplace_back(u.dot(p), v.dot(p));
    }
    loops.push_back(std::move(loop));
  }
  const Triangle& beside = mesh.triangles[static_cast<std::size_t>(together.front()->triangle)];
  Triangle fill = {.corners = {}, .number = beside.number, .line = beside.line};
  for (const auto& [a, b, c] : geometry::Triangulated(flat, loops)) {
    const auto corner = [&](int i) { return vertex[static_cast<std::size_t>(i)]; };
    fill.corners = {corner(a), corner(b), corner(c)};
    mesh.triangles.push_back(fill);
  }
}

}  // namespace

Closing CloseOpenings(TriangleMesh& mesh, double tolerance) {
  std::vector<Opening> openings = RimWalk(mesh).Openings();
  std::ranges::stable_sort(openings, std::ranges::greater(),
                           [](const Opening& opening) { return opening.normal.norm(); });
  Closing closing{.openings = static_cast<int>(openings.size())};
  std::vector<bool> is_filled(openings.size(), false);
  for (std::size_t i = 0; i < openings.size(); ++i) {
    if (is_filled[i]) continue;
    std::vector<const Opening*> together = {&openings[i]};
    if (!IsSlit(mesh, openings[i], tolerance)) {
      if (OffPlane(mesh, openings[i], openings[i]) > tolerance) {
        Refuse(mesh, mesh.triangles[static_cast<std::size_t>(openings[i].triangle)],
               "the surface is open here, and the opening is not planar",
               "a closed surface, or planar openings");
      }
      // Openings in one plane are filled together, because one may lie around another.
      for (std::size_t j = i + 1; j < openings.size(); ++j) {
        if (is_filled[j] || IsSlit(mesh, openings[j], tolerance) ||
            OffPlane(mesh, openings[j], openings[i]) > tolerance)
          continue;
        together.push_back(&openings[j]);
        is_filled[j] = true;
      }
    }
    Vector3 area = Vector3::Zero();
    for (const Opening* opening : together) area += opening->normal;
    closing.area += area.norm();
    Fill(mesh, together);
  }
  return closing;
}

}  // namespace assay::mesh_import
