#include "planner/geometry/solids/polygon_pieces.h"

#include <algorithm>

#include "planner/base/check.h"
#include "planner/geometry/outline.h"
#include "planner/geometry/planar_region.h"

namespace assay::geometry {
namespace {

constexpr double kSameLength = 1e-9;  // metres

double CrossOf(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

double SignedArea(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    twice += CrossOf(ring[i], ring[(i + 1) % ring.size()]);
  }
  return twice / 2;
}

// Returns how far p is to the left of the line from a to b.
double LeftOf(const Vector2& a, const Vector2& b, const Vector2& p) {
  return CrossOf((b - a).normalized(), p - a);
}

bool SegmentsMeet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  const auto low = [](const Vector2& p, const Vector2& q) -> Vector2 { return p.cwiseMin(q); };
  const auto high = [](const Vector2& p, const Vector2& q) -> Vector2 { return p.cwiseMax(q); };
  const bool boxes_meet = (low(a, b).array() <= high(c, d).array() + kSameLength).all() &&
                          (low(c, d).array() <= high(a, b).array() + kSameLength).all();
  const auto straddles = [](const Vector2& p, const Vector2& q, const Vector2& r,
                            const Vector2& s) {
    const double left_r = LeftOf(p, q, r);
    const double left_s = LeftOf(p, q, s);
    return std::min(left_r, left_s) <= kSameLength && std::max(left_r, left_s) >= -kSameLength;
  };
  return boxes_meet && straddles(a, b, c, d) && straddles(c, d, a, b);
}

// Returns whether the corner at `tip` can be cut off: it is convex, and no other corner is in its
// triangle.
bool IsEar(const Ring& ring, std::size_t tip) {
  const Vector2& before = ring[(tip + ring.size() - 1) % ring.size()];
  const Vector2& at = ring[tip];
  const Vector2& after = ring[(tip + 1) % ring.size()];
  if (LeftOf(before, at, after) <= 0) return false;
  return std::ranges::none_of(ring, [&](const Vector2& p) {
    if (p == before || p == at || p == after) return false;
    return LeftOf(before, at, p) >= 0 && LeftOf(at, after, p) >= 0 && LeftOf(after, before, p) >= 0;
  });
}

std::vector<Polygon> Triangles(Ring ring) {
  if (SignedArea(ring) < 0) std::ranges::reverse(ring);
  std::vector<Polygon> triangles;
  while (ring.size() >= 3) {
    std::size_t tip = 0;
    while (tip < ring.size() && !IsEar(ring, tip)) ++tip;
    // Only corners on straight lines are left if there is no ear.
    if (tip == ring.size()) break;
    const std::size_t before = (tip + ring.size() - 1) % ring.size();
    const std::size_t after = (tip + 1) % ring.size();
    triangles.push_back({ring[before], ring[tip], ring[after]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(tip));
  }
  return triangles;
}

std::vector<Polygon> MergedInPlane(const std::vector<Polygon>& polygons) {
  std::vector<Outline> region;
  for (const Polygon& polygon : polygons) {
    Outline& outline = region.emplace_back();
    for (const Vector2& p : polygon) outline.emplace_back(p.x(), p.y(), 0);
  }
  std::vector<Polygon> merged;
  for (const Outline& outline : Merged(std::move(region), Vector3::UnitZ(), kSameLength)) {
    Polygon& polygon = merged.emplace_back();
    for (const Vector3& p : outline) polygon.push_back(p.head<2>());
  }
  return merged;
}

}  // namespace

bool IsSimple(const Ring& ring) {
  const std::size_t count = ring.size();
  if (count < 3) return false;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2& a = ring[i];
    const Vector2& b = ring[(i + 1) % count];
    if ((b - a).norm() <= kSameLength) return false;
    for (std::size_t j = i + 2; j < count; ++j) {
      if (i == 0 && j + 1 == count) continue;
      if (SegmentsMeet(a, b, ring[j], ring[(j + 1) % count])) return false;
    }
    // A side that folds back onto its neighbour.
    const Vector2& c = ring[(i + 2) % count];
    if (std::abs(LeftOf(a, b, c)) <= kSameLength && (b - a).dot(c - b) < 0) return false;
  }
  return true;
}

bool SidesMeet(const Ring& a, const Ring& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (SegmentsMeet(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()])) return true;
    }
  }
  return false;
}

bool IsInside(const Ring& ring, const Vector2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2& a = ring[i];
    const Vector2& b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

std::vector<Polygon> ConvexPieces(const Ring& outline, std::span<const Ring> holes) {
  Patches region = Triangles(outline);
  for (const Ring& hole : holes) {
    for (const Polygon& triangle : Triangles(hole)) region = Without(region, triangle);
  }
  return MergedInPlane(region);
}

}  // namespace assay::geometry
