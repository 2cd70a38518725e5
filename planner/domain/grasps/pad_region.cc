#include "planner/domain/grasps/pad_region.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/polygon.h"

namespace assay::domain {
namespace {

using geometry::Polygon;

constexpr double kGridStep = 4e-3;  // distance between candidate positions, metres

}  // namespace

double ExtentOf(const Polygon& polygon, const Vector2& direction) {
  const auto height = [&](const Vector2& p) { return direction.dot(p); };
  const auto [low, high] = std::ranges::minmax(polygon, {}, height);
  return height(high) - height(low);
}

double BreadthOf(const Polygon& polygon) {
  double breadth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2 along = (polygon[(i + 1) % polygon.size()] - polygon[i]).normalized();
    breadth = std::min(breadth, ExtentOf(polygon, Vector2(-along.y(), along.x())));
  }
  return breadth;
}

PadRegion::PadRegion(const geometry::Patches& region)
    : outline_(geometry::Hull(region)), gaps_({outline_}) {
  for (const Polygon& patch : region) gaps_ = geometry::Without(gaps_, patch);
}

double PadRegion::ClearanceAt(const Vector2& p) const {
  double least = geometry::Depth(outline_, p);
  for (const Polygon& gap : gaps_) {
    const double outside = -geometry::Depth(gap, p);  // at most the distance
    if (outside >= least) continue;
    least = outside < 0 ? outside : std::min(least, std::max(outside, geometry::Gap({p}, gap)));
  }
  return least;
}

double PadRegion::MarginOf(const Polygon& pad, double floor) const {
  double least = kDeepEnough;
  for (const Vector2& corner : pad) {
    if (least <= floor) break;
    least = std::min(least, geometry::Depth(outline_, corner));
  }
  for (const Polygon& gap : gaps_) {
    if (least < 0 || least <= floor) break;
    least = std::min(least, geometry::Gap(pad, gap, least));
  }
  return least;
}

PadRoom PadRegion::Lacking(const Polygon& pad, double overhang) const {
  PadRoom least;
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const Vector2 along = (outline_[(i + 1) % outline_.size()] - outline_[i]).normalized();
    const Vector2 across(-along.y(), along.x());
    const PadRoom room = {ExtentOf(pad, across), ExtentOf(outline_, across)};
    if (i == 0 || room.needed - room.available > least.needed - least.available) least = room;
  }
  if (least.fits()) least.available = least.needed - 2 * overhang;
  return least;
}

Eigen::AlignedBox2d PadRegion::Bounds() const {
  Eigen::AlignedBox2d bounds;
  for (const Vector2& p : outline_) bounds.extend(p);
  return bounds;
}

std::vector<Spot> SpotsOf(const geometry::Patches& region, const PadRegion& room,
                          const Vector2& first, const Vector2& mass_center) {
  std::vector<Spot> spots;
  // Numbers of the order are rounded, so that rounding errors do not order equal spots.
  const auto rounded = [](double length) { return std::llround(length / kEqualLength); };
  const auto add = [&](const Vector2& p) {
    const double clearance = room.ClearanceAt(p);
    if (clearance < 0) return;
    spots.push_back(
        {p, clearance, {rounded((p - mass_center).norm()), rounded(p.x()), rounded(p.y())}});
  };
  add(first);
  const Vector2 origin = geometry::Centroid(region);
  const Eigen::AlignedBox2d bounds = room.Bounds();
  const Vector2 below = ((bounds.min() - origin) / kGridStep).array().ceil();
  const Vector2 above = ((bounds.max() - origin) / kGridStep).array().floor();
  for (int i = static_cast<int>(below.x()); i <= static_cast<int>(above.x()); ++i) {
    for (int j = static_cast<int>(below.y()); j <= static_cast<int>(above.y()); ++j) {
      add(origin + kGridStep * Vector2(i, j));
    }
  }
  std::ranges::stable_sort(spots, {}, &Spot::order);
  return spots;
}

}  // namespace assay::domain
