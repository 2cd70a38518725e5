#include "planner/geometry/contact/contact_patch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace assay::geometry {
namespace {

constexpr double kSamePoint = 1e-6;  // m
// A facet is left out if the cosine of the angle between the facet and the plane is less than this.
// Such a facet is steep, or faces away from the plane. A steep facet is near the plane only along
// an edge. This edge also belongs to another facet, which is less steep and is not left out. With a
// limit of 0, rounding would decide whether a steep facet is left out.
constexpr double kSteep = 1e-3;
// The first direction, in turns between two directions. It is not a simple fraction, so that the
// corners of a regular polygon are not equally far in a direction.
constexpr double kFirstDirection = 0.3819;

// Removes the part of a convex polygon above a plane.
void ClipBelow(const Plane& plane, Outline& outline, std::vector<double>& heights,
               Outline& clipped) {
  heights.clear();
  for (const Vector3& corner : outline) heights.push_back(plane.Above(corner));
  if (std::ranges::all_of(heights, [](double height) { return height <= 0; })) return;
  clipped.clear();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const std::size_t next = (i + 1) % outline.size();
    if (heights[i] <= 0) clipped.push_back(outline[i]);
    if ((heights[i] <= 0) == (heights[next] <= 0)) continue;
    const double share = heights[i] / (heights[i] - heights[next]);
    clipped.push_back(outline[i] + share * (outline[next] - outline[i]));
  }
  outline.swap(clipped);
}

// Removes the parts of a convex polygon beyond the sides of a facet.
void ClipToFacet(const ContactSolid& solid, int facet, Outline& outline) {
  const auto& [middle, radius] = solid.discs[facet];
  const auto is_on_disc = [&](const Vector3& corner) {
    return (corner - middle).squaredNorm() <= radius * radius;
  };
  if (std::ranges::all_of(outline, is_on_disc)) return;
  Outline clipped;
  std::vector<double> heights;
  for (const Plane& border : solid.borders[facet]) ClipBelow(border, outline, heights, clipped);
}

bool IsAmong(std::span<const Vector3> points, const Vector3& point) {
  return std::ranges::any_of(points, [&](const Vector3& other) {
    return (other - point).squaredNorm() < kSamePoint * kSamePoint;
  });
}

}  // namespace

std::vector<Vector3> CommonCorners(const ContactSolid& of, int facet, const ContactSolid& other,
                                   const Pose& X_OfOther, double margin) {
  const Plane plane = of.PlaneOf(facet);
  const Vector3 in_other = X_OfOther.linear().transpose() * plane.normal;
  const double above = margin - plane.Above(X_OfOther.translation());
  const Eigen::VectorXd heights = other.vertices * in_other;
  std::vector<Vector3> corners;
  for (const Facet& candidate : other.hull.facets) {
    const auto is_low = [&](int vertex) { return heights[vertex] <= above; };
    if (candidate.normal.dot(in_other) > -kSteep) continue;
    if (std::ranges::none_of(candidate.loop, is_low)) continue;
    Outline outline;
    for (const int vertex : candidate.loop) {
      outline.push_back(X_OfOther * other.hull.vertices[vertex]);
    }
    ClipToFacet(of, facet, outline);
    const std::size_t of_others = corners.size();  // facets share corners and edges
    for (const Vector3& corner : outline) {
      if (plane.Above(corner) > margin || IsAmong(std::span(corners).first(of_others), corner)) {
        continue;
      }
      corners.push_back(corner);
    }
  }
  return corners;
}

std::vector<Vector3> Outermost(const std::vector<Vector3>& points, const Vector3& normal,
                               std::size_t most) {
  if (points.size() <= most) return points;
  // The directions must not jump where the normal trembles.
  const Vector3 aside = std::abs(normal.x()) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
  const Vector3 u = normal.cross(aside).normalized();
  const Vector3 v = normal.cross(u);
  std::vector<Vector3> outermost;
  for (std::size_t i = 0; i < most; ++i) {
    const double angle = 2 * std::numbers::pi * (static_cast<double>(i) + kFirstDirection) /
                         static_cast<double>(most);
    const Vector3 direction = std::cos(angle) * u + std::sin(angle) * v;
    const auto reach = [&](const Vector3& point) { return direction.dot(point); };
    const Vector3& farthest = *std::ranges::max_element(points, {}, reach);
    if (!IsAmong(outermost, farthest)) outermost.push_back(farthest);
  }
  return outermost;
}

}  // namespace assay::geometry
