#include "planner/mesh_import/sections/contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

#include "planner/geometry/ring.h"

namespace assay::mesh_import {
namespace {

constexpr std::size_t kLeastCircleCorners = 12;
constexpr double kCircleShare = 2e-3;  // corners may be off the circle by this share of the radius
constexpr double kWidestGap = 40 * std::numbers::pi / 180;  // between corners, seen from the centre
constexpr double kLeastSideShare =
    0.5;  // of a rectangle's side, that is left beside rounded corners

double DistanceToEdge(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 along = b - a;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0;
  return (p - a - share * along).norm();
}

double DistanceToPolygon(const Vector2& p, std::span<const Vector2> polygon) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    least = std::min(least, DistanceToEdge(p, polygon[i], polygon[(i + 1) % polygon.size()]));
  return least;
}

// Marks those points between two kept points that must be kept as well.
void KeepBetween(std::span<const Vector2> curve, std::size_t from, std::size_t to, double tolerance,
                 std::vector<bool>& kept) {
  std::vector<std::pair<std::size_t, std::size_t>> open = {{from, to}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    double farthest = tolerance;
    std::size_t at = begin;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double off = DistanceToEdge(curve[i], curve[begin], curve[end % curve.size()]);
      if (off <= farthest) continue;
      farthest = off;
      at = i;
    }
    if (at == begin) continue;
    kept[at] = true;
    open.emplace_back(begin, at);
    open.emplace_back(at, end);
  }
}

// Unmarks points that lie on a side between two kept points. KeepBetween keeps such a point where
// the side is parallel to the chord, because all points of the side are then equally far from it.
void LeaveOutNeedless(std::span<const Vector2> curve, double tolerance, std::vector<bool>& kept) {
  const std::size_t count = curve.size();
  const auto next_kept = [&](std::size_t i) {
    do i = (i + 1) % count;
    while (!kept[i]);
    return i;
  };
  const auto is_straight = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = (from + 1) % count; i != to; i = (i + 1) % count) {
      if (DistanceToEdge(curve[i], curve[from], curve[to]) > tolerance) return false;
    }
    return true;
  };
  auto left = static_cast<std::size_t>(std::ranges::count(kept, true));
  std::size_t before = 0;
  while (!kept[before]) ++before;
  for (std::size_t tried = left; tried > 0 && left > 3; --tried) {
    const std::size_t here = next_kept(before);
    if (is_straight(before, next_kept(here))) {
      kept[here] = false;
      --left;
    } else {
      before = here;
    }
  }
}

std::size_t FarthestFrom(std::span<const Vector2> curve, const Vector2& p) {
  const auto far =
      std::ranges::max_element(curve, {}, [&](const Vector2& q) { return (q - p).squaredNorm(); });
  return static_cast<std::size_t>(far - curve.begin());
}

struct Circle {
  Vector2 center;
  double radius = 0;
};

// Returns the circle that is nearest to points by least squares (Kasa 1976), or none if they are
// not around it.
std::optional<Circle> CircleThrough(std::span<const Vector2> points) {
  Vector2 middle = Vector2::Zero();
  for (const Vector2& p : points) middle += p / static_cast<double>(points.size());
  double xx = 0;
  double xy = 0;
  double yy = 0;
  double x = 0;
  double y = 0;
  double squares = 0;
  for (const Vector2& p : points) {
    const Vector2 d = p - middle;
    const double square = d.squaredNorm();
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
    x += square * d.x() / 2;
    y += square * d.y() / 2;
    squares += square / static_cast<double>(points.size());
  }
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-6 * (xx + yy) * (xx + yy))) return std::nullopt;
  const Vector2 offset((x * yy - y * xy) / determinant, (y * xx - x * xy) / determinant);
  return Circle{middle + offset, std::sqrt(squares + offset.squaredNorm())};
}

bool IsAround(std::span<const Vector2> corners, const Circle& circle, double tolerance) {
  double turn = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2 a = corners[i] - circle.center;
    const Vector2 b = corners[(i + 1) % corners.size()] - circle.center;
    if (std::abs(a.norm() - circle.radius) > tolerance) return false;
    const double angle = std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    if (angle <= 0 || angle > kWidestGap) return false;
    turn += angle;
  }
  return std::abs(turn - 2 * std::numbers::pi) < 0.1;
}

// Returns how many decimals a length has in millimetres, up to 3.
int DecimalsOf(double length) {
  constexpr double kDecimalRounding = 5e-4;  // millimetres
  double unit = 1;
  for (int decimals = 0; decimals < 3; ++decimals, unit /= 10) {
    if (std::abs(std::remainder(length * 1000, unit)) < kDecimalRounding) return decimals;
  }
  return 3;
}

double RadiusOfSides(std::span<const Vector2> corners, const Vector2& center) {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += ((corners[i] + corners[(i + 1) % corners.size()]) / 2 - center).norm();
  return sum / static_cast<double>(corners.size());
}

std::optional<Contour> AsCircle(const std::vector<Vector2>& corners, double tolerance) {
  if (corners.size() < kLeastCircleCorners) return std::nullopt;
  const std::optional<Circle> circle = CircleThrough(corners);
  if (!circle || !IsAround(corners, *circle, std::max(tolerance, kCircleShare * circle->radius)))
    return std::nullopt;
  const double of_sides = RadiusOfSides(corners, circle->center);
  const bool is_of_sides = DecimalsOf(2 * of_sides) <= 1 && DecimalsOf(2 * circle->radius) >= 3;
  return Contour{.kind = Contour::Kind::kCircle,
                 .corners = corners,
                 .center = circle->center,
                 .radius = is_of_sides ? of_sides : circle->radius,
                 .is_circle_of_sides = is_of_sides};
}

std::vector<Vector2> CornersOf(const Eigen::AlignedBox2d& bounds) {
  return {bounds.min(),
          {bounds.max().x(), bounds.min().y()},
          bounds.max(),
          {bounds.min().x(), bounds.max().y()}};
}

// Returns the length of polygon that lies along a side of its bounding box.
double LengthAlong(std::span<const Vector2> polygon, const Vector2& a, const Vector2& b,
                   double tolerance) {
  double length = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& p = polygon[i];
    const Vector2& q = polygon[(i + 1) % polygon.size()];
    if (DistanceToEdge(p, a, b) <= tolerance && DistanceToEdge(q, a, b) <= tolerance)
      length += (q - p).norm();
  }
  return length;
}

std::optional<Contour> AsRectangle(const std::vector<Vector2>& corners, const ContourFit& fit) {
  Eigen::AlignedBox2d bounds;
  for (const Vector2& corner : corners) bounds.extend(corner);
  Contour rectangle{
      .kind = Contour::Kind::kRectangle, .corners = CornersOf(bounds), .center = bounds.center()};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector2& a = rectangle.corners[i];
    const Vector2& b = rectangle.corners[(i + 1) % 4];
    if (LengthAlong(corners, a, b, fit.tolerance) < kLeastSideShare * (b - a).norm())
      return std::nullopt;
    rectangle.left_out = std::max(rectangle.left_out, DistanceToPolygon(a, corners));
  }
  if (rectangle.left_out <= fit.tolerance) rectangle.left_out = 0;
  const bool fills = std::ranges::all_of(corners, [&](const Vector2& corner) {
    return DistanceToPolygon(corner, rectangle.corners) <=
           std::max(fit.tolerance, fit.most_left_out);
  });
  if (!fills || rectangle.left_out > fit.most_left_out) return std::nullopt;
  return rectangle;
}

// Returns the centroid of the area, or a corner if there is no area.
Vector2 CentroidOf(std::span<const Vector2> polygon) {
  if (polygon.empty()) return Vector2::Zero();
  Vector2 sum = Vector2::Zero();
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vector2 a = polygon[i - 1] - polygon[0];
    const Vector2 b = polygon[i] - polygon[0];
    const double own = a.x() * b.y() - a.y() * b.x();
    sum += own * (a + b) / 3;
    area += own;
  }
  return area == 0 ? polygon[0] : Vector2(polygon[0] + sum / area);
}

// Leaves out corners at which a curve turns back on itself.
void LeaveOutSpikes(std::vector<Vector2>& corners, double tolerance) {
  for (std::size_t i = 0; i < corners.size() && corners.size() > 3;) {
    const std::size_t count = corners.size();
    const Vector2& before = corners[(i + count - 1) % count];
    const Vector2& after = corners[(i + 1) % count];
    if (DistanceToEdge(after, before, corners[i]) > tolerance &&
        DistanceToEdge(before, corners[i], after) > tolerance) {
      ++i;
      continue;
    }
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
}

}  // namespace

Eigen::AlignedBox2d Contour::Bounds() const {
  if (IsCircle()) {
    const Vector2 reach = Vector2::Constant(radius);
    return {center - reach, center + reach};
  }
  Eigen::AlignedBox2d bounds;
  for (const Vector2& corner : corners) bounds.extend(corner);
  return bounds;
}

double Contour::Area() const {
  return IsCircle() ? std::numbers::pi * radius * radius : geometry::SignedArea(corners);
}

bool Contour::Contains(const Vector2& p) const {
  if (IsCircle()) return (p - center).norm() <= radius;
  return geometry::IsInside(corners, p);
}

double Contour::DistanceTo(const Vector2& p) const {
  if (IsCircle()) return std::abs((p - center).norm() - radius);
  return DistanceToPolygon(p, corners);
}

double Contour::Reach(const Vector2& direction) const {
  if (IsCircle()) return radius;
  const Vector2 unit = direction.normalized();
  double reach = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2 along = corners[(i + 1) % corners.size()] - corners[i];
    const Vector2 outward(along.y(), -along.x());
    const double approach = outward.dot(unit);
    if (approach > 0) reach = std::min(reach, outward.dot(corners[i] - center) / approach);
  }
  return reach;
}

std::vector<Vector2> Contour::Outline(int sides) const {
  if (!IsCircle()) return corners;
  std::vector<Vector2> outline;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    outline.push_back(center + radius * Vector2(std::cos(angle), std::sin(angle)));
  }
  return outline;
}

std::vector<Vector2> Simplified(std::span<const Vector2> curve, double tolerance) {
  if (curve.size() < 3) return {curve.begin(), curve.end()};
  Vector2 middle = Vector2::Zero();
  for (const Vector2& p : curve) middle += p / static_cast<double>(curve.size());
  std::vector<Vector2> turned(curve.begin(), curve.end());
  std::ranges::rotate(turned,
                      turned.begin() + static_cast<std::ptrdiff_t>(FarthestFrom(curve, middle)));
  const std::size_t opposite = FarthestFrom(turned, turned.front());
  std::vector<bool> kept(turned.size(), false);
  kept[0] = true;
  kept[opposite] = true;
  KeepBetween(turned, 0, opposite, tolerance, kept);
  KeepBetween(turned, opposite, turned.size(), tolerance, kept);
  LeaveOutNeedless(turned, tolerance, kept);
  std::vector<Vector2> simplified;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (kept[i]) simplified.push_back(turned[i]);
  }
  return simplified;
}

Contour FitContour(std::span<const Vector2> curve, const ContourFit& fit) {
  std::vector<Vector2> corners = Simplified(curve, fit.tolerance);
  LeaveOutSpikes(corners, fit.tolerance);
  if (geometry::SignedArea(corners) < 0) std::ranges::reverse(corners);
  if (std::optional<Contour> circle = AsCircle(corners, fit.tolerance)) return *std::move(circle);
  if (std::optional<Contour> rectangle = AsRectangle(corners, fit)) return *std::move(rectangle);
  Contour polygon{.kind = Contour::Kind::kPolygon, .corners = std::move(corners)};
  polygon.center = CentroidOf(polygon.corners);
  return polygon;
}

bool AreEqual(const Contour& a, const Contour& b, double tolerance) {
  if (a.IsCircle() && b.IsCircle())
    return (a.center - b.center).norm() + std::abs(a.radius - b.radius) <= tolerance;
  const auto is_near = [&](const Contour& from, const Contour& to) {
    return std::ranges::all_of(from.corners,
                               [&](const Vector2& p) { return to.DistanceTo(p) <= tolerance; });
  };
  return is_near(a, b) && is_near(b, a);
}

}  // namespace assay::mesh_import
