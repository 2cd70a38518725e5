#include "planner/mesh_import/decomposition/convex_decomposition.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/hull.h"
#include "planner/mesh_import/decomposition/concave_planes.h"
#include "planner/mesh_import/decomposition/piece_distance.h"
#include "planner/mesh_import/meshes/plane_cut.h"
#include "planner/mesh_import/repair/shells.h"

namespace assay::mesh_import {
namespace {

using geometry::ConvexHull;

constexpr int kRoughHull = 60;         // points of a hull that only measures a cut
constexpr int kFineHull = 200;         // points of a piece
constexpr double kThinnest = 1e-4;     // thickness of a flat set of points, as a share of its size
constexpr double kSizeWeight = 1e-3;   // of the cube of a part's size, in the cost of a cut
constexpr double kLeastVolume = 1e-6;  // of a part, as a share of the whole mesh's volume
constexpr double kPlaneRounding = 1e-6;  // of a plane, as a share of the mesh's size

// Returns directions that are spread evenly over the sphere, along a spiral.
std::vector<Vector3> SpreadDirections(int count) {
  std::vector<Vector3> directions;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count;
    const double angle = 2.399963229728653 * i;  // the golden angle
    const double radius = std::sqrt(1 - z * z);
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return directions;
}

std::vector<Vector3> ExtremesOf(std::span<const Vector3> points, int most) {
  if (points.size() <= static_cast<std::size_t>(most)) return {points.begin(), points.end()};
  std::vector<Vector3> directions = SpreadDirections(most - 6);
  for (int axis = 0; axis < 3; ++axis) {
    directions.push_back(Vector3::Unit(axis));
    directions.push_back(-Vector3::Unit(axis));
  }
  std::vector<bool> is_taken(points.size(), false);
  std::vector<Vector3> extremes;
  for (const Vector3& direction : directions) {
    const auto farthest =
        std::ranges::max_element(points, {}, [&](const Vector3& p) { return direction.dot(p); });
    const auto index = static_cast<std::size_t>(farthest - points.begin());
    if (!is_taken[index]) extremes.push_back(*farthest);
    is_taken[index] = true;
  }
  return extremes;
}

// Returns whether points span a solid that is thicker than kThinnest: the greatest tetrahedron that
// a greedy choice finds has this height.
bool SpanSolid(std::span<const Vector3> points) {
  if (points.size() < 4) return false;
  const auto farthest = [&](const auto& distance) {
    return *std::ranges::max_element(points, {}, distance);
  };
  const Vector3 a = points.front();
  const Vector3 b = farthest([&](const Vector3& p) { return (p - a).norm(); });
  const double size = (b - a).norm();
  if (size == 0) return false;
  const Vector3 along = (b - a) / size;
  const Vector3 c = farthest([&](const Vector3& p) { return (p - a).cross(along).norm(); });
  const Vector3 normal = along.cross(Vector3(c - a));
  if (normal.norm() <= kThinnest * size) return false;
  const Vector3 unit = normal.normalized();
  const Vector3 d = farthest([&](const Vector3& p) { return std::abs(unit.dot(p - a)); });
  return std::abs(unit.dot(d - a)) > kThinnest * size;
}

// A closed part of the mesh with its hull.
struct Part {
  TriangleMesh mesh;
  ConvexHull hull;
  double excess = 0;  // volume of the hull beyond that of the part
  double depth = -1;  // greatest depth of the surface in the hull, metres; negative: unknown
  bool is_final = false;
};

std::optional<Part> PartOf(TriangleMesh mesh, int hull_points) {
  std::optional<ConvexHull> hull = HullOfExtremes(mesh.vertices, hull_points);
  if (!hull) return std::nullopt;
  const double excess = VolumeOf(*hull) - mesh.Volume();
  return Part{.mesh = std::move(mesh), .hull = *std::move(hull), .excess = excess};
}

class Decomposer {
 public:
  Decomposer(const TriangleMesh& mesh, const DecompositionRules& rules)
      : rules_(rules),
        least_volume_(kLeastVolume * mesh.Volume()),
        rounding_(kPlaneRounding * mesh.Size()) {
    Add(mesh, kFineHull, parts_);
  }

  std::vector<ConvexHull> Pieces() {
    while (static_cast<int>(parts_.size()) < rules_.most_pieces && CutDeepest()) {
    }
    std::vector<ConvexHull> pieces;
    for (const Part& part : parts_) pieces.push_back(part.hull);
    return pieces;
  }

 private:
  void Add(const TriangleMesh& mesh, int hull_points, std::vector<Part>& parts) const {
    if (mesh.triangles.empty()) return;
    for (TriangleMesh& shell : ShellsOf(mesh)) {
      if (shell.Volume() <= least_volume_) continue;
      if (std::optional<Part> part = PartOf(std::move(shell), hull_points))
        parts.push_back(*std::move(part));
    }
  }

  // Returns the volume by which the hulls of both sides of a cut exceed the sides, and in addition
  // a small cost for the size of the sides. The first cut of a ring makes no hull better, but cuts
  // of its halves do, so the small cost must decide about the first cut.
  double CostOf(const TriangleMesh& mesh, const CutPlane& plane) const {
    const auto [below, above] = CutBy(mesh, plane);
    std::vector<Part> parts;
    Add(below, kRoughHull, parts);
    Add(above, kRoughHull, parts);
    double cost = 0;
    for (const Part& part : parts)
      cost += std::max(part.excess, 0.0) + kSizeWeight * std::pow(part.mesh.Size(), 3);
    return parts.size() < 2 ? std::numeric_limits<double>::infinity() : cost;
  }

  // Cuts the part whose surface is deepest in its hull. Returns false if no part is to be cut.
  bool CutDeepest() {
    for (Part& part : parts_) {
      if (part.depth < 0) part.depth = DepthOf(part.mesh, part.hull);
    }
    const auto deepest = std::ranges::max_element(
        parts_, {}, [](const Part& part) { return part.is_final ? -1.0 : part.depth; });
    if (deepest == parts_.end() || deepest->is_final || deepest->depth <= rules_.depth)
      return false;
    const TriangleMesh mesh = deepest->mesh;
    double least = std::numeric_limits<double>::infinity();
    std::optional<CutPlane> best;
    for (CutPlane plane : ConcavePlanesOf(mesh)) {
      plane.tolerance = rounding_;
      const double cost = CostOf(mesh, plane);
      if (cost >= least) continue;
      least = cost;
      best = plane;
    }
    deepest->is_final = true;
    if (!best) return true;
    std::vector<Part> fresh;
    const auto [below, above] = CutBy(mesh, *best);
    Add(below, kFineHull, fresh);
    Add(above, kFineHull, fresh);
    if (fresh.size() < 2) return true;
    parts_.erase(deepest);
    std::ranges::move(fresh, std::back_inserter(parts_));
    return true;
  }

  const DecompositionRules rules_;
  const double least_volume_;
  const double rounding_;
  std::vector<Part> parts_;
};

}  // namespace

std::optional<ConvexHull> HullOfExtremes(std::span<const Vector3> points, int most) {
  const std::vector<Vector3> extremes = ExtremesOf(points, most);
  if (!SpanSolid(extremes)) return std::nullopt;
  return geometry::HullOf(extremes);
}

double VolumeOf(const ConvexHull& hull) {
  const Vector3 about = hull.vertices.front();
  double volume = 0;
  for (const geometry::Facet& facet : hull.facets) {
    const auto at = [&](std::size_t i) -> Vector3 {
      return hull.vertices[static_cast<std::size_t>(facet.loop[i])] - about;
    };
    for (std::size_t i = 2; i < facet.loop.size(); ++i)
      volume += at(0).dot(at(i - 1).cross(at(i))) / 6;
  }
  return volume;
}

Decomposition Decompose(const TriangleMesh& mesh, const DecompositionRules& rules) {
  Decomposition decomposition{.pieces = Decomposer(mesh, rules).Pieces()};
  if (decomposition.pieces.empty())
    Refuse(mesh, mesh.triangles.front(), "this belongs to a body that is flat", "a solid");
  double volume = 0;
  for (const ConvexHull& piece : decomposition.pieces) volume += VolumeOf(piece);
  decomposition.volume_share = volume / mesh.Volume() - 1;
  decomposition.distance = DistanceBetween(mesh, decomposition.pieces);
  return decomposition;
}

}  // namespace assay::mesh_import
