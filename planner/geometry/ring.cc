#include "planner/geometry/ring.h"

#include <algorithm>
#include <cmath>

namespace assay::geometry {
namespace {

constexpr double kSameLength = 1e-9;  // metres

double CrossOf(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

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

}  // namespace

double SignedArea(std::span<const Vector2> ring) {
  double twice = 0;
  for (std::size_t i = 2; i < ring.size(); ++i)
    twice += CrossOf(ring[i - 1] - ring[0], ring[i] - ring[0]);
  return twice / 2;
}

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

bool IsInside(std::span<const Vector2> ring, const Vector2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2& a = ring[i];
    const Vector2& b = ring[(i + 1) % ring.size()];
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

Ring MovedOutward(const Ring& convex, double by) {
  Ring moved;
  for (std::size_t i = 0; i < convex.size(); ++i) {
    const Vector2& at = convex[i];
    const Vector2 in = (at - convex[(i + convex.size() - 1) % convex.size()]).normalized();
    const Vector2 out = (convex[(i + 1) % convex.size()] - at).normalized();
    const Vector2 normal_in(in.y(), -in.x());
    const Vector2 normal_out(out.y(), -out.x());
    moved.push_back(at + by / (1 + normal_in.dot(normal_out)) * (normal_in + normal_out));
  }
  return moved;
}

}  // namespace assay::geometry
