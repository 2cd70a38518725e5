#include "planner/mesh_import/sections/nearly_even.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace assay::mesh_import {
namespace {

// Returns the circle around sections of an outline, or within those of a hole, if they are nearly
// round.
std::optional<Contour> CircleOfSections(const Column& curve,
                                        const std::vector<const Column*>& sections, double nearly) {
  constexpr int kCorners = 48;
  constexpr std::size_t kFewestCorners = 12;
  Contour circle;
  circle.kind = Contour::Kind::kCircle;
  circle.center = curve.at_low.center;
  double inner = std::numeric_limits<double>::infinity();
  double outer = 0;
  for (const Column* section : sections) {
    const std::vector<Vector2> outline = section->at_low.Outline(kCorners);
    if (outline.size() < kFewestCorners) return std::nullopt;
    inner = std::min(inner, section->at_low.DistanceTo(circle.center));
    for (const Vector2& p : outline) outer = std::max(outer, (p - circle.center).norm());
  }
  if (outer - inner > nearly) return std::nullopt;
  circle.radius = curve.is_hole ? inner : outer;
  circle.corners = circle.Outline(kCorners);
  return circle;
}

}  // namespace

std::vector<const Column*> LikeCurves(const Column& curve,
                                      const std::vector<const Curves*>& sections) {
  std::vector<const Column*> alike;
  for (const Curves* section : sections) {
    const Column* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const Column& other : *section) {
      const double off =
          (other.at_low.center - curve.at_low.center).norm() +
          std::abs(other.at_low.Area() - curve.at_low.Area()) / std::sqrt(curve.at_low.Area());
      if (other.is_hole != curve.is_hole || off >= least) continue;
      nearest = &other;
      least = off;
    }
    if (nearest != nullptr) alike.push_back(nearest);
  }
  return alike;
}

double MaterialBeyond(const Column& column, const std::vector<const Column*>& sections) {
  constexpr int kCorners = 48;
  double beyond = 0;
  for (const Column* section : sections) {
    for (const Vector2& p : section->at_low.Outline(kCorners)) {
      if (column.at_low.Contains(p) == column.is_hole)
        beyond = std::max(beyond, column.at_low.DistanceTo(p));
    }
  }
  return beyond;
}

Column NearlyEvenColumn(const Column& curve, const std::vector<const Curves*>& sections,
                        const ColumnRules& rules) {
  const std::vector<const Column*> alike = LikeCurves(curve, sections);
  Column column = **std::ranges::max_element(
      alike, {}, [&](const Column* of) { return (curve.is_hole ? -1 : 1) * of->at_low.Area(); });
  const double beyond = MaterialBeyond(column, alike);
  if (beyond <= rules.tolerance) return column;
  if (std::optional<Contour> circle = CircleOfSections(curve, alike, MostOfNearlyEven(rules))) {
    column.at_low = *std::move(circle);
    return column;
  }
  column.is_step = true;
  column.beyond = beyond;
  return column;
}

}  // namespace assay::mesh_import
