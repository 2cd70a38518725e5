#include "planner/kinematics/meshes/mesh_pieces.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "planner/base/check.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::kinematics {
namespace {

using geometry::ConvexHull;
using geometry::Vector3;
using Surface = std::vector<SurfaceTriangle>;

constexpr double kLeastGain = 0.05;  // of the volume of the whole hull
constexpr std::size_t kMostPieces = 8;
constexpr std::array kCuts = {0.25, 0.5, 0.75};  // shares of a piece's extent

std::vector<Vector3> PointsOf(const Surface& surface) {
  std::vector<Vector3> points;
  for (const SurfaceTriangle& triangle : surface) {
    points.insert(points.end(), triangle.begin(), triangle.end());
  }
  return points;
}

// Returns how far below the plane a coordinate is, or 0 if it nearly lies in the plane.
double DepthBelow(double at, double coordinate) {
  const double distance = at - coordinate;
  return std::abs(distance) <= kSamePoint ? 0 : distance;
}

// Adds the part of a triangle that has `sign` times its coordinate at most `sign` times `at`.
// Corners that nearly lie in the plane count as lying in it.
void AddBelow(const SurfaceTriangle& triangle, int axis, double at, double sign, Surface& part) {
  std::vector<Vector3> polygon;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3& a = triangle[i];
    const Vector3& b = triangle[(i + 1) % 3];
    const double below_a = sign * DepthBelow(at, a[axis]);
    const double below_b = sign * DepthBelow(at, b[axis]);
    if (below_a >= 0) polygon.push_back(a);
    if (below_a * below_b < 0) {
      Vector3 crossing = a + below_a / (below_a - below_b) * (b - a);
      crossing[axis] = at;
      polygon.push_back(crossing);
    }
  }
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    part.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }
}

// A part of the solid: its part of the surface, and the hull of this part. The hull contains the
// part of the solid, because the extreme points of the part lie on the surface: around any other
// point, the solid continues on both sides within the plane of the cut.
struct Piece {
  Surface surface;
  ConvexHull hull;
  double volume = 0;
};

// Returns none if the surface spans no space.
std::optional<Piece> PieceOf(Surface surface) {
  const std::vector<Vector3> points = PointsOf(surface);
  if (points.size() < 4 || !geometry::SpanSpace(points, kThinnestSolid)) return std::nullopt;
  Piece piece{.surface = std::move(surface), .hull = geometry::HullOf(points, kSamePoint)};
  piece.volume = geometry::Volume(piece.hull);
  return piece;
}

struct Cut {
  Piece low;
  Piece high;
  double gain = 0;  // by which the volume becomes smaller
};

std::optional<Cut> CutAt(const Piece& piece, int axis, double at) {
  Surface low;
  Surface high;
  for (const SurfaceTriangle& triangle : piece.surface) {
    const bool is_in_plane = std::ranges::all_of(
        triangle, [&](const Vector3& corner) { return DepthBelow(at, corner[axis]) == 0; });
    if (is_in_plane) {
      // The solid is behind the triangle.
      const Vector3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
      (normal[axis] > 0 ? low : high).push_back(triangle);
      continue;
    }
    AddBelow(triangle, axis, at, 1, low);
    AddBelow(triangle, axis, at, -1, high);
  }
  std::optional<Piece> one = PieceOf(std::move(low));
  std::optional<Piece> other = PieceOf(std::move(high));
  if (!one || !other) return std::nullopt;
  const double gain = piece.volume - one->volume - other->volume;
  return Cut{std::move(*one), std::move(*other), gain};
}

// Returns the cut that makes the volume smallest, if it gains at least as much as is asked for.
std::optional<Cut> BestCut(const Piece& piece, double least_gain) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3& vertex : piece.hull.vertices) bounds.extend(vertex);
  std::optional<Cut> best;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double share : kCuts) {
      const double at = std::lerp(bounds.min()[axis], bounds.max()[axis], share);
      std::optional<Cut> cut = CutAt(piece, axis, at);
      const bool is_better = cut && (best ? cut->gain > best->gain : cut->gain >= least_gain);
      if (is_better) best = std::move(cut);
    }
  }
  return best;
}

}  // namespace

std::vector<ConvexHull> ConvexPiecesOf(const std::vector<SurfaceTriangle>& surface) {
  std::optional<Piece> whole = PieceOf(surface);
  ASSAY_CHECK(whole.has_value(), "a surface that spans no space");
  const double least_gain = kLeastGain * whole->volume;
  std::vector<Piece> open = {std::move(*whole)};
  std::vector<ConvexHull> pieces;
  while (!open.empty()) {
    const auto largest = std::ranges::max_element(open, {}, &Piece::volume);
    std::swap(*largest, open.back());
    Piece piece = std::move(open.back());
    open.pop_back();
    std::optional<Cut> cut;
    if (open.size() + pieces.size() + 2 <= kMostPieces) cut = BestCut(piece, least_gain);
    if (cut) {
      open.push_back(std::move(cut->low));
      open.push_back(std::move(cut->high));
    } else {
      pieces.push_back(std::move(piece.hull));
    }
  }
  return pieces;
}

}  // namespace assay::kinematics
