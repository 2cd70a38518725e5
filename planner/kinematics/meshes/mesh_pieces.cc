#include "planner/kinematics/meshes/mesh_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include "planner/base/check.h"
#include "planner/geometry/solids/mass_properties.h"

namespace assay::kinematics {
namespace {

using geometry::ConvexHull;
using geometry::Vector3;
using Surface = std::vector<SurfaceTriangle>;

constexpr std::size_t kMostPieces = 8;
constexpr std::array kCuts = {0.25, 0.5, 0.75};  // shares of a piece's extent

// Returns the corners of the triangles, each once.
std::vector<Vector3> PointsOf(const Surface& surface) {
  std::vector<Vector3> points;
  for (const SurfaceTriangle& triangle : surface) {
    points.insert(points.end(), triangle.begin(), triangle.end());
  }
  const auto order = [](const Vector3& p) { return std::tuple(p.x(), p.y(), p.z()); };
  std::ranges::sort(points, {}, order);
  points.erase(std::unique(points.begin(), points.end()), points.end());
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

// Returns unit vectors in all directions: a spiral over the sphere, and the axes and diagonals.
std::vector<Vector3> Directions() {
  constexpr int kSpiral = 74;
  std::vector<Vector3> directions;
  for (int i = 0; i < kSpiral; ++i) {
    const double z = 1 - (2 * i + 1.0) / kSpiral;
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - z * z);
    directions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  for (int i = 0; i < 27; ++i) {
    const Vector3 direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (!direction.isZero()) directions.push_back(direction.normalized());
  }
  return directions;
}

// Returns the volume of the hull of the extreme points in some directions. It is a quick estimate,
// which is never too large. Returns none if the surface spans no space.
std::optional<double> EstimatedVolume(const Surface& surface) {
  static const std::vector<Vector3> directions = Directions();
  const std::vector<Vector3> points = PointsOf(surface);
  if (points.size() < 4) return std::nullopt;
  std::vector<Vector3> extremes;
  for (const Vector3& direction : directions) {
    extremes.push_back(*std::ranges::max_element(
        points, {}, [&](const Vector3& point) { return direction.dot(point); }));
  }
  if (!geometry::SpanSpace(extremes, kThinnestSolid)) return std::nullopt;
  return geometry::Volume(geometry::HullOf(extremes, kSamePoint));
}

// A part of the solid: its part of the surface, and the hull of this part. The hull contains the
// part of the solid, because the extreme points of the part lie on the surface: around any other
// point, the solid continues on both sides along the planes of the cuts. This holds for cuts across
// two axes. Three planes would meet in a point that may be inside the solid.
struct Piece {
  Surface surface;
  ConvexHull hull;
  double volume = 0;
  std::array<bool, 3> is_cut_across = {};  // by axis
};

// Returns none if the surface spans no space.
std::optional<Piece> PieceOf(Surface surface, const std::array<bool, 3>& is_cut_across) {
  const std::vector<Vector3> points = PointsOf(surface);
  if (points.size() < 4 || !geometry::SpanSpace(points, kThinnestSolid)) return std::nullopt;
  Piece piece{.surface = std::move(surface),
              .hull = geometry::HullOf(points, kSamePoint),
              .is_cut_across = is_cut_across};
  piece.volume = geometry::Volume(piece.hull);
  return piece;
}

// The parts of a surface below and above a plane across an axis.
struct CutSurface {
  int axis = 0;
  Surface low;
  Surface high;
};

CutSurface CutAt(const Surface& surface, int axis, double at) {
  CutSurface cut{.axis = axis, .low = {}, .high = {}};
  for (const SurfaceTriangle& triangle : surface) {
    const bool is_in_plane = std::ranges::all_of(
        triangle, [&](const Vector3& corner) { return DepthBelow(at, corner[axis]) == 0; });
    if (is_in_plane) {
      // The solid is behind the triangle.
      const Vector3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
      (normal[axis] > 0 ? cut.low : cut.high).push_back(triangle);
      continue;
    }
    AddBelow(triangle, axis, at, 1, cut.low);
    AddBelow(triangle, axis, at, -1, cut.high);
  }
  return cut;
}

bool MayBeCutAcross(const Piece& piece, int axis) {
  std::array<bool, 3> cut = piece.is_cut_across;
  cut[static_cast<std::size_t>(axis)] = true;
  return std::ranges::count(cut, true) < 3;
}

// Returns the cut that promises the smallest volume. There may be none.
std::optional<CutSurface> MostPromisingCut(const Piece& piece) {
  Eigen::AlignedBox3d bounds;
  for (const Vector3& vertex : piece.hull.vertices) bounds.extend(vertex);
  std::optional<CutSurface> best;
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (!MayBeCutAcross(piece, axis)) continue;
    for (const double share : kCuts) {
      CutSurface cut =
          CutAt(piece.surface, axis, std::lerp(bounds.min()[axis], bounds.max()[axis], share));
      const std::optional<double> low = EstimatedVolume(cut.low);
      const std::optional<double> high = EstimatedVolume(cut.high);
      if (!low || !high || *low + *high >= least) continue;
      least = *low + *high;
      best = std::move(cut);
    }
  }
  return best;
}

// Returns the two parts of a piece if they have together a volume that is smaller by this gain.
std::optional<std::pair<Piece, Piece>> Cut(const Piece& piece, double least_gain) {
  std::optional<CutSurface> cut = MostPromisingCut(piece);
  if (!cut) return std::nullopt;
  std::array<bool, 3> is_cut_across = piece.is_cut_across;
  is_cut_across[static_cast<std::size_t>(cut->axis)] = true;
  std::optional<Piece> low = PieceOf(std::move(cut->low), is_cut_across);
  std::optional<Piece> high = PieceOf(std::move(cut->high), is_cut_across);
  if (!low || !high || piece.volume - low->volume - high->volume < least_gain) return std::nullopt;
  return std::pair(std::move(*low), std::move(*high));
}

}  // namespace

std::vector<ConvexHull> ConvexPiecesOf(const std::vector<SurfaceTriangle>& surface) {
  std::optional<Piece> whole = PieceOf(surface, {});
  ASSAY_CHECK(whole.has_value(), "a surface that spans no space");
  const double least_gain = kLeastCutGain * whole->volume;
  std::vector<Piece> open = {std::move(*whole)};
  std::vector<ConvexHull> pieces;
  while (!open.empty()) {
    const auto largest = std::ranges::max_element(open, {}, &Piece::volume);
    std::swap(*largest, open.back());
    Piece piece = std::move(open.back());
    open.pop_back();
    std::optional<std::pair<Piece, Piece>> parts;
    if (open.size() + pieces.size() + 2 <= kMostPieces) parts = Cut(piece, least_gain);
    if (parts) {
      open.push_back(std::move(parts->first));
      open.push_back(std::move(parts->second));
    } else {
      pieces.push_back(std::move(piece.hull));
    }
  }
  return pieces;
}

}  // namespace assay::kinematics
