#include "planner/mesh_import/meshes/plane_cut.h"

#include <cstdint>
#include <numeric>
#include <unordered_map>

namespace assay::mesh_import {
namespace {

using geometry::Loop;

std::size_t Place(int index) { return static_cast<std::size_t>(index); }

// One cut of one mesh. The vertices of the mesh keep their numbers, and crossings follow.
class MeshCut {
 public:
  MeshCut(const TriangleMesh& mesh, const CutPlane& plane) : mesh_(mesh), points_(mesh.vertices) {
    height_.reserve(mesh.vertices.size());
    for (const Vector3& vertex : mesh.vertices) {
      const double above = plane.normal.dot(vertex) - plane.height;
      height_.push_back(std::abs(above) <= plane.tolerance ? 0 : above);
    }
    for (const Triangle& triangle : mesh.triangles) Split(triangle);
  }

  Section Curves() {
    Section section{.points = {}, .loops = Loops()};
    std::unordered_map<int, int> number;
    for (Loop& loop : section.loops) {
      for (int& point : loop) {
        const auto [known, is_new] =
            number.try_emplace(point, static_cast<int>(section.points.size()));
        if (is_new) section.points.push_back(points_[Place(point)]);
        point = known->second;
      }
    }
    return section;
  }

  // Returns the part below the plane. What lies in the plane is above it.
  TriangleMesh PartBelow(const CutPlane& plane) {
    const Vector3 u = plane.normal.unitOrthogonal();
    const Vector3 v = plane.normal.cross(u);
    const std::vector<Loop> loops = Loops();
    std::vector<Vector2> flat;
    for (const Vector3& point : points_) flat.emplace_back(u.dot(point), v.dot(point));
    for (const auto& [a, b, c] : geometry::Triangulated(flat, loops))
      below_.push_back({.corners = {a, b, c}, .number = 0, .line = 0});
    std::vector<int> every(below_.size());
    std::iota(every.begin(), every.end(), 0);
    return SubMesh({.file = mesh_.file, .vertices = points_, .triangles = below_}, every);
  }

 private:
  bool IsAbove(int vertex) const { return height_[Place(vertex)] >= 0; }

  // Returns the point where an edge crosses the plane. A vertex in the plane is its own crossing.
  int Crossing(int a, int b) {
    if (a > b) std::swap(a, b);
    const double at_a = height_[Place(a)];
    const double at_b = height_[Place(b)];
    if (at_a == 0) return a;
    if (at_b == 0) return b;
    const std::uint64_t key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
    const auto [known, is_new] = crossings_.try_emplace(key, static_cast<int>(points_.size()));
    if (is_new) {
      const double share = at_a / (at_a - at_b);
      points_.push_back(points_[Place(a)] + share * (points_[Place(b)] - points_[Place(a)]));
    }
    return known->second;
  }

  // Adds a piece of a triangle to what is below.
  void Add(Triangle triangle, int a, int b, int c) {
    if (a == b || b == c || c == a) return;
    triangle.corners = {a, b, c};
    below_.push_back(triangle);
  }

  void Split(const Triangle& triangle) {
    int count = 0;
    for (const int corner : triangle.corners) count += IsAbove(corner);
    if (count == 3) return;
    if (count == 0) return below_.push_back(triangle);
    int alone = 0;  // the corner on its own side
    while (IsAbove(triangle.corners[Place(alone)]) != (count == 1)) ++alone;
    const int a = triangle.corners[Place(alone)];
    const int b = triangle.corners[Place((alone + 1) % 3)];
    const int c = triangle.corners[Place((alone + 2) % 3)];
    const int ab = Crossing(a, b);
    const int ca = Crossing(c, a);
    if (count == 1) {
      Add(triangle, ab, b, c);
      Add(triangle, ab, c, ca);
    } else {
      Add(triangle, a, ab, ca);
    }
    if (ab == ca) return;
    // The inside of the mesh is to the left of the curve.
    if (count == 1) {
      next_.emplace(ab, ca);
    } else {
      next_.emplace(ca, ab);
    }
  }

  // Links the crossings to closed curves. Where the mesh is closed, each point begins as many
  // pieces of curves as it ends. What is left open at other points is dropped.
  std::vector<Loop> Loops() {
    std::vector<Loop> loops;
    std::unordered_multimap<int, int> rest = next_;
    while (!rest.empty()) {
      const int start = rest.begin()->first;
      Loop loop;
      int at = start;
      for (auto found = rest.find(at); found != rest.end(); found = rest.find(at)) {
        loop.push_back(at);
        at = found->second;
        rest.erase(found);
        if (at == start) break;
      }
      if (at == start) loops.push_back(std::move(loop));
    }
    return loops;
  }

  const TriangleMesh& mesh_;
  std::vector<Vector3> points_;
  std::vector<double> height_;  // of each vertex of the mesh above the plane
  std::unordered_map<std::uint64_t, int> crossings_;
  std::unordered_multimap<int, int> next_;  // along the curves
  std::vector<Triangle> below_;
};

}  // namespace

Section SectionOf(const TriangleMesh& mesh, const CutPlane& plane) {
  return MeshCut(mesh, plane).Curves();
}

std::pair<TriangleMesh, TriangleMesh> CutBy(const TriangleMesh& mesh, const CutPlane& plane) {
  // Facets in the plane belong to neither part, so that no part has a fin without thickness.
  const CutPlane reversed = {
      .normal = -plane.normal, .height = -plane.height, .tolerance = plane.tolerance};
  return {MeshCut(mesh, plane).PartBelow(plane), MeshCut(mesh, reversed).PartBelow(reversed)};
}

}  // namespace assay::mesh_import
