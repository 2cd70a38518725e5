#include "planner/geometry/outline.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "planner/geometry/polygon.h"

namespace assay::geometry {
namespace {

Segment SideOf(const Outline& outline, std::size_t i) {
  return {outline[i], outline[(i + 1) % outline.size()]};
}

double DistanceToLine(const Segment& line, const Vector3& p) {
  return (line.end - line.start).cross(p - line.start).norm() / line.Length();
}

double AreaOf(const Outline& outline) {
  Vector3 doubled = Vector3::Zero();
  for (std::size_t i = 2; i < outline.size(); ++i) {
    doubled += (outline[i - 1] - outline[0]).cross(outline[i] - outline[0]);
  }
  return doubled.norm() / 2;
}

double PerimeterOf(const Outline& outline) {
  double perimeter = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) perimeter += SideOf(outline, i).Length();
  return perimeter;
}

void DropCollinearCorners(Outline& outline, double tolerance) {
  for (std::size_t i = 0; i < outline.size() && outline.size() > 3;) {
    const Segment across = {outline[(i + outline.size() - 1) % outline.size()],
                            outline[(i + 1) % outline.size()]};
    if (across.Length() > 0 && DistanceToLine(across, outline[i]) > tolerance) {
      ++i;
    } else {
      outline.erase(outline.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;
    }
  }
}

Outline HullInPlane(const Outline& points, const Vector3& normal, double tolerance) {
  const Vector3 u = normal.unitOrthogonal();
  const Vector3 v = normal.cross(u);
  std::vector<Vector2> projected;
  for (const Vector3& p : points) projected.emplace_back(u.dot(p), v.dot(p));
  Outline hull;
  for (const Vector2& corner : Hull2(projected)) {
    hull.push_back(points[std::ranges::find(projected, corner) - projected.begin()]);
  }
  DropCollinearCorners(hull, tolerance);
  return hull;
}

// Returns whether two segments share more than `tolerance` of a line.
bool RunTogether(const Segment& a, const Segment& b, double tolerance) {
  if (a.Length() <= tolerance || b.Length() <= tolerance) return false;
  if (DistanceToLine(a, b.start) > tolerance || DistanceToLine(a, b.end) > tolerance) return false;
  const Vector3 along = (a.end - a.start).normalized();
  const auto [low, high] = std::minmax({along.dot(b.start - a.start), along.dot(b.end - a.start)});
  return std::min(high, a.Length()) - std::max(low, 0.0) > tolerance;
}

bool ShareASide(const Outline& a, const Outline& b, double tolerance) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (RunTogether(SideOf(a, i), SideOf(b, k), tolerance)) return true;
    }
  }
  return false;
}

}  // namespace

bool IsBroad(const Outline& outline, double tolerance) {
  if (outline.size() < 3) return false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Segment side = SideOf(outline, i);
    if (side.Length() == 0) continue;
    const auto is_far = [&](const Vector3& p) { return DistanceToLine(side, p) > tolerance; };
    if (std::ranges::none_of(outline, is_far)) return false;
  }
  return true;
}

Halves Split(const Outline& outline, const Plane& plane, double tolerance) {
  Halves halves;
  bool reaches_above = false;
  bool reaches_below = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto [p, q] = SideOf(outline, i);
    const double at_p = plane.Above(p);
    const double at_q = plane.Above(q);
    if (at_p >= -tolerance) halves.above.push_back(p);
    if (at_p <= tolerance) halves.below.push_back(p);
    reaches_above |= at_p > tolerance;
    reaches_below |= at_p < -tolerance;
    if (std::min(at_p, at_q) < -tolerance && std::max(at_p, at_q) > tolerance) {
      const Vector3 crossing = p + at_p / (at_p - at_q) * (q - p);
      halves.above.push_back(crossing);
      halves.below.push_back(crossing);
    }
  }
  if (!reaches_above) halves.above.clear();
  if (reaches_above && !reaches_below) halves.below.clear();
  return halves;
}

std::vector<Outline> Merged(std::vector<Outline> region, const Vector3& normal, double tolerance) {
  for (std::size_t i = 0; i < region.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      Outline both = region[k];
      both.insert(both.end(), region[i].begin(), region[i].end());
      const Outline hull = HullInPlane(both, normal, tolerance);
      const double gap = AreaOf(hull) - AreaOf(region[k]) - AreaOf(region[i]);
      if (gap > tolerance * PerimeterOf(hull)) continue;
      region[k] = hull;
      region.erase(region.begin() + static_cast<std::ptrdiff_t>(i));
      i = 0;  // polygons that did not fit with k may fit after the merge
      break;
    }
  }
  return region;
}

std::vector<std::vector<Outline>> ConnectedParts(const std::vector<Outline>& region,
                                                 double tolerance) {
  std::vector<std::vector<Outline>> parts;
  for (const Outline& outline : region) {
    std::vector<Outline> grown;
    const auto absorb = [&](const std::vector<Outline>& part) {
      const bool touches = std::ranges::any_of(
          part, [&](const Outline& other) { return ShareASide(outline, other, tolerance); });
      if (touches) grown.insert(grown.end(), part.begin(), part.end());
      return touches;
    };
    std::erase_if(parts, absorb);
    grown.push_back(outline);
    parts.push_back(std::move(grown));
  }
  return parts;
}

double DistanceOutside(const Outline& outline, const Vector3& normal, const Vector3& p) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto [start, end] = SideOf(outline, i);
    farthest = std::max(farthest, (end - start).cross(normal).normalized().dot(p - start));
  }
  return farthest;
}

}  // namespace assay::geometry
