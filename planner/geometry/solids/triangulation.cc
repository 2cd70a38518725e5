#include "planner/geometry/solids/triangulation.h"

#include <algorithm>
#include <limits>

#include "planner/geometry/ring.h"

namespace assay::geometry {
namespace {

using Points = std::span<const Vector2>;

// Cutting ears takes time that grows with the square of the number of corners. Longer loops become
// fans.
constexpr std::size_t kMostEarCorners = 4000;
// A loop that crosses itself can have few ears. After so many tries for each corner the rest
// becomes a fan.
constexpr std::size_t kMostTries = 100;

const Vector2& PointAt(Points points, int index) { return points[static_cast<std::size_t>(index)]; }

// Returns twice the signed area of a triangle.
double TwiceAreaOf(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool IsInTriangle(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& p) {
  return TwiceAreaOf(a, b, p) >= 0 && TwiceAreaOf(b, c, p) >= 0 && TwiceAreaOf(c, a, p) >= 0;
}

Ring RingOf(Points points, const Loop& loop) {
  Ring ring;
  for (const int i : loop) ring.push_back(PointAt(points, i));
  return ring;
}

std::vector<std::array<int, 3>> FanOf(const Loop& loop) {
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t i = 2; i < loop.size(); ++i)
    triangles.push_back({loop[0], loop[i - 1], loop[i]});
  return triangles;
}

// Cuts ears off one loop without holes.
class EarCutter {
 public:
  EarCutter(Points points, Loop loop) : points_(points), loop_(std::move(loop)) {}

  std::vector<std::array<int, 3>> Cut() {
    std::size_t at = 0;
    std::size_t tries = kMostTries * loop_.size();
    std::size_t in_vain = 0;
    while (loop_.size() > 3 && in_vain < loop_.size() && tries > 0) {
      at %= loop_.size();
      ++in_vain;
      --tries;
      if (!IsEar(at)) {
        ++at;
        continue;
      }
      triangles_.push_back({loop_[Before(at)], loop_[at], loop_[After(at)]});
      const std::size_t before = Before(at);
      loop_.erase(loop_.begin() + static_cast<std::ptrdiff_t>(at));
      // Ears come in rows. Both neighbours are tried next, so that a row is cut in one pass.
      at = before < at ? before : loop_.size() - 1;
      in_vain = 0;
    }
    std::ranges::move(FanOf(loop_), std::back_inserter(triangles_));
    return std::move(triangles_);
  }

 private:
  std::size_t Before(std::size_t i) const { return (i + loop_.size() - 1) % loop_.size(); }
  std::size_t After(std::size_t i) const { return (i + 1) % loop_.size(); }

  bool IsEar(std::size_t i) const {
    const Vector2& a = PointAt(points_, loop_[Before(i)]);
    const Vector2& b = PointAt(points_, loop_[i]);
    const Vector2& c = PointAt(points_, loop_[After(i)]);
    if (TwiceAreaOf(a, b, c) <= 0) return false;
    return std::ranges::none_of(loop_, [&](int other) {
      const Vector2& p = PointAt(points_, other);
      return p != a && p != b && p != c && IsInTriangle(a, b, c, p);
    });
  }

  Points points_;
  Loop loop_;
  std::vector<std::array<int, 3>> triangles_;
};

// Returns whether the corner i of a loop opens towards p: p is between its two sides, on the inside.
bool OpensTowards(Points points, const Loop& loop, std::size_t i, const Vector2& p) {
  const Vector2& before = PointAt(points, loop[(i + loop.size() - 1) % loop.size()]);
  const Vector2& at = PointAt(points, loop[i]);
  const Vector2& after = PointAt(points, loop[(i + 1) % loop.size()]);
  const bool left_of_first = TwiceAreaOf(before, at, p) >= 0;
  const bool left_of_second = TwiceAreaOf(at, after, p) >= 0;
  if (TwiceAreaOf(before, at, after) >= 0) return left_of_first && left_of_second;
  return left_of_first || left_of_second;
}

// Returns the place of a corner that lies where the given one lies, and opens towards p. The ends
// of earlier bridges occur twice in the loop.
std::ptrdiff_t CopyTowards(Points points, const Loop& loop, std::ptrdiff_t corner,
                           const Vector2& p) {
  const Vector2& at = PointAt(points, loop[static_cast<std::size_t>(corner)]);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (PointAt(points, loop[i]) == at && OpensTowards(points, loop, i, p))
      return static_cast<std::ptrdiff_t>(i);
  }
  return corner;
}

// Returns the place in the outer loop to which a bridge from the point p (of a hole) leads: the
// nearest corner that p sees to its right (Eberly 2008). Returns none if there is no loop there.
std::ptrdiff_t BridgeFrom(Points points, const Loop& outer, const Vector2& p) {
  std::ptrdiff_t best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const Vector2& a = PointAt(points, outer[i]);
    const std::size_t next = (i + 1) % outer.size();
    const Vector2& b = PointAt(points, outer[next]);
    if (a.y() > p.y() || b.y() < p.y() || a.y() == b.y()) continue;  // edges to the right go up
    const double x = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (x < p.x() || x >= nearest) continue;
    nearest = x;
    best = static_cast<std::ptrdiff_t>(a.x() > b.x() ? i : next);
  }
  if (best < 0) return best;
  const Vector2 crossing(nearest, p.y());
  const Vector2 corner = PointAt(points, outer[static_cast<std::size_t>(best)]);
  const auto sees_less = [&](const Vector2& q) {
    return corner.y() >= p.y() ? IsInTriangle(p, crossing, corner, q)
                               : IsInTriangle(p, corner, crossing, q);
  };
  double steepest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outer.size(); ++i) {
    const Vector2& q = PointAt(points, outer[i]);
    if (q == corner || q.x() <= p.x() || !sees_less(q)) continue;
    const double slope = std::abs(q.y() - p.y()) / (q.x() - p.x());
    if (slope >= steepest) continue;
    steepest = slope;
    best = static_cast<std::ptrdiff_t>(i);
  }
  return CopyTowards(points, outer, best, p);
}

// Joins a hole with its outer loop by a bridge that is walked in both directions. Returns false if
// the hole is not in the loop.
bool JoinHole(Points points, Loop& outer, const Loop& hole) {
  const auto rightmost = std::ranges::max_element(
      hole, {}, [&](int i) { return std::pair(PointAt(points, i).x(), PointAt(points, i).y()); });
  const std::ptrdiff_t bridge = BridgeFrom(points, outer, PointAt(points, *rightmost));
  if (bridge < 0) return false;
  Loop way(rightmost, hole.end());
  way.insert(way.end(), hole.begin(), rightmost);
  way.push_back(*rightmost);
  way.push_back(outer[static_cast<std::size_t>(bridge)]);
  outer.insert(outer.begin() + bridge + 1, way.begin(), way.end());
  return true;
}

double RightEnd(Points points, const Loop& loop) {
  double right = -std::numeric_limits<double>::infinity();
  for (const int i : loop) right = std::max(right, PointAt(points, i).x());
  return right;
}

// Returns the index of the smallest outer loop around a hole; -1 if there is none.
int LoopAround(Points points, const std::vector<Ring>& outers, const std::vector<double>& areas,
               const Loop& hole) {
  int best = -1;
  for (int i = 0; i < static_cast<int>(outers.size()); ++i) {
    if (!IsInside(outers[static_cast<std::size_t>(i)], PointAt(points, hole.front()))) continue;
    if (best < 0 || areas[static_cast<std::size_t>(i)] < areas[static_cast<std::size_t>(best)])
      best = i;
  }
  return best;
}

}  // namespace

std::vector<std::array<int, 3>> Triangulated(Points points, const std::vector<Loop>& loops) {
  std::vector<Loop> outers;
  std::vector<double> areas;
  std::vector<Loop> holes;
  std::vector<std::array<int, 3>> triangles;
  for (const Loop& loop : loops) {
    const double area = SignedArea(RingOf(points, loop));
    if (loop.size() < 3 || loop.size() > kMostEarCorners || area == 0) {
      std::ranges::move(FanOf(loop), std::back_inserter(triangles));
    } else if (area > 0) {
      outers.push_back(loop);
      areas.push_back(area);
    } else {
      holes.push_back(loop);
    }
  }
  std::ranges::stable_sort(holes, std::ranges::greater(),
                           [&](const Loop& hole) { return RightEnd(points, hole); });
  std::vector<Ring> alone;
  for (const Loop& outer : outers) alone.push_back(RingOf(points, outer));
  for (const Loop& hole : holes) {
    const int around = LoopAround(points, alone, areas, hole);
    if (around < 0 || !JoinHole(points, outers[static_cast<std::size_t>(around)], hole))
      std::ranges::move(FanOf(hole), std::back_inserter(triangles));
  }
  for (Loop& outer : outers)
    std::ranges::move(EarCutter(points, std::move(outer)).Cut(), std::back_inserter(triangles));
  return triangles;
}

}  // namespace assay::geometry
