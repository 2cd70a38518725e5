#include "planner/plan/checker/resting_balance.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/geometry/hull.h"

namespace assay::plan {
namespace {

using geometry::Vector2;
using geometry::Vector3;

constexpr double kTouch = 1e-6;      // metres from the table
constexpr double kSameLine = 1e-9;   // metres between grid lines that count as one
constexpr double kHalfPlane = 1e-9;  // radians
// Uniform grid lines along each axis, in addition to the corners'.
constexpr int kSubdivisions = 32;

void SortAndUnite(std::vector<double>& lines) {
  std::ranges::sort(lines);
  const auto same = [](double a, double b) { return b - a < kSameLine; };
  lines.erase(std::unique(lines.begin(), lines.end(), same), lines.end());
}

// Returns the grid lines along one axis: the corners' coordinates, and uniform ones between them.
// Parts with many corners have no use for the first kind, because they are round.
std::vector<double> GridLines(std::span<const Vector3> corners, int axis) {
  std::vector<double> lines;
  for (const Vector3& corner : corners) lines.push_back(corner[axis]);
  SortAndUnite(lines);
  const double low = lines.front();
  const double high = lines.back();
  if (lines.size() > 2 * kSubdivisions) lines = {low, high};
  for (int i = 1; i < kSubdivisions; ++i) lines.push_back(low + (high - low) * i / kSubdivisions);
  SortAndUnite(lines);
  return lines;
}

// The circle of a round solid that is nearest to a point along the axis.
struct Circle {
  Vector3 lowest;
  double radius = 0;
};
Circle CircleThrough(const Vector3& p, const geometry::RoundSolid& round) {
  const double length = (round.ends[1] - round.ends[0]).norm();
  const Vector3 axis = (round.ends[1] - round.ends[0]) / length;
  const double along = std::clamp((p - round.ends[0]).dot(axis), 0.0, length);
  const double radius = std::lerp(round.radii[0], round.radii[1], along / length);
  const Vector3 down = -Vector3::UnitZ() + axis.z() * axis;  // across the axis
  const Vector3 middle = round.ends[0] + along * axis;
  if (down.norm() < kHalfPlane) return {middle, 0};  // an upright solid stands on its end
  return {middle + radius * down.normalized(), radius};
}

}  // namespace

Vector3 CenterOfMass(std::span<const geometry::ConvexHull> solids) {
  const std::vector<Vector3> corners = VerticesOf(solids);
  const std::array<std::vector<double>, 3> lines = {GridLines(corners, 0), GridLines(corners, 1),
                                                    GridLines(corners, 2)};
  double volume = 0;
  Vector3 moment = Vector3::Zero();
  for (std::size_t i = 1; i < lines[0].size(); ++i) {
    for (std::size_t j = 1; j < lines[1].size(); ++j) {
      for (std::size_t k = 1; k < lines[2].size(); ++k) {
        const Vector3 low(lines[0][i - 1], lines[1][j - 1], lines[2][k - 1]);
        const Vector3 high(lines[0][i], lines[1][j], lines[2][k]);
        const Vector3 middle = (low + high) / 2;
        const bool filled = std::ranges::any_of(
            solids, [&](const geometry::ConvexHull& solid) { return Contains(solid, middle, 0); });
        if (!filled) continue;
        volume += (high - low).prod();
        moment += (high - low).prod() * middle;
      }
    }
  }
  return moment / volume;
}

std::vector<Vector3> TouchingTable(std::span<const Vector3> corners,
                                   std::span<const geometry::RoundSolid> round_solids) {
  std::vector<Vector3> touching;
  for (const Vector3& corner : corners) {
    if (std::abs(corner.z()) > kTouch) continue;
    Vector3 touch = corner;
    for (const geometry::RoundSolid& round : round_solids) {
      const Circle circle = CircleThrough(corner, round);
      const double half_side = circle.radius * std::tan(M_PI / round.sides);
      const bool is_beside = (circle.lowest - corner).norm() <= half_side + kTouch;
      if (is_beside && std::abs(circle.lowest.z()) <= kTouch) touch = circle.lowest;
    }
    touching.push_back(touch);
  }
  return touching;
}

bool IsSupported(const Vector3& p, std::span<const Vector3> points) {
  std::vector<double> directions;
  for (const Vector3& point : points) {
    const Vector2 to_point = (point - p).head<2>();
    if (to_point.norm() > kTouch) directions.push_back(std::atan2(to_point.y(), to_point.x()));
  }
  if (directions.size() < 3) return false;
  std::ranges::sort(directions);
  double widest = directions.front() + 2 * M_PI - directions.back();
  for (std::size_t i = 1; i < directions.size(); ++i) {
    widest = std::max(widest, directions[i] - directions[i - 1]);
  }
  return widest < M_PI - kHalfPlane;
}

const Vector3* FirstOutside(std::span<const Vector3> points, const geometry::Polygon& polygon) {
  const auto is_outside = [&](const Vector3& p) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
      const Vector2 to_p = p.head<2>() - polygon[i];
      if (edge.x() * to_p.y() - edge.y() * to_p.x() < -kTouch * edge.norm()) return true;
    }
    return false;
  };
  const auto found = std::ranges::find_if(points, is_outside);
  return found == points.end() ? nullptr : &*found;
}

}  // namespace assay::plan
