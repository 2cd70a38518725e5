#include "planner/mesh_import/sections/notches.h"

#include <algorithm>
#include <optional>

#include "planner/geometry/ring.h"
#include "planner/mesh_import/sections/contour.h"

namespace assay::mesh_import {
namespace {

constexpr double kMostShare = 0.5;  // of the area of the polygon

using NotchedPolygon = std::vector<Vector2>;

// Returns how many corners after `begin` the notch that begins there ends; none if no notch begins
// there.
std::optional<std::size_t> LengthOfNotch(const NotchedPolygon& polygon, std::size_t begin,
                                         double tolerance) {
  const std::size_t count = polygon.size();
  const auto at = [&](std::size_t i) -> const Vector2& { return polygon[i % count]; };
  const Vector2 lip = at(begin);
  const Vector2 along = (lip - at(begin + count - 1)).normalized();
  const Vector2 inward(-along.y(), along.x());
  for (std::size_t length = 1; length + 2 < count; ++length) {
    const Vector2 to = at(begin + length) - lip;
    const double depth = inward.dot(to);
    if (depth < -tolerance) return std::nullopt;
    if (depth > tolerance) continue;
    if (length < 3 || along.dot(to) <= tolerance) return std::nullopt;
    const Vector2 next = at(begin + length + 1) - at(begin + length);
    const bool goes_on = std::abs(inward.dot(next)) <= tolerance && along.dot(next) > tolerance;
    return goes_on ? std::optional(length) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Notch> FillNotches(std::vector<Vector2>& polygon, double tolerance) {
  std::vector<Notch> notches;
  for (std::size_t begin = 0; begin < polygon.size() && polygon.size() >= 8;) {
    const std::optional<std::size_t> length = LengthOfNotch(polygon, begin, tolerance);
    NotchedPolygon outline;
    for (std::size_t i = 0; length && i <= *length; ++i)
      outline.push_back(polygon[(begin + i) % polygon.size()]);
    std::ranges::reverse(outline);
    if (!length || geometry::SignedArea(outline) > kMostShare * geometry::SignedArea(polygon)) {
      ++begin;
      continue;
    }
    const Vector2 mouth = (outline.front() - outline.back()).normalized();
    notches.push_back({.outline = outline, .outward = {mouth.y(), -mouth.x()}});
    NotchedPolygon filled;
    for (std::size_t i = *length + 1; i < polygon.size(); ++i)
      filled.push_back(polygon[(begin + i) % polygon.size()]);
    polygon = std::move(filled);
    begin = 0;
  }
  if (!notches.empty()) polygon = Simplified(polygon, tolerance);
  return notches;
}

}  // namespace assay::mesh_import
