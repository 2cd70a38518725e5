#include "planner/geometry/convex_cut.h"

#include <algorithm>
#include <map>
#include <utility>

#include "planner/base/check.h"
#include "planner/geometry/rounded_hull.h"

namespace assay::geometry {
namespace {

constexpr double kThinnest = 1e-9;  // metres

using Loop = std::vector<int>;

// One cut of a solid by a plane. Vertices within kThinnest of the plane count as on it.
class Cut {
 public:
  Cut(const ConvexHull& solid, const Plane& plane) : solid_(solid), plane_(plane) {
    for (const Vector3& vertex : solid.vertices) above_.push_back(plane.Above(vertex));
    number_.assign(solid.vertices.size(), -1);
  }

  bool KeepsAll() const { return std::ranges::max(above_) <= kThinnest; }
  bool KeepsNothing() const { return std::ranges::min(above_) >= -kThinnest; }

  ConvexHull Below() {
    std::vector<Loop> loops;
    for (const Facet& facet : solid_.facets) {
      Loop loop = Kept(facet.loop);
      if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    loops.push_back(Cap(loops));
    return HullWith(std::move(vertices_), std::move(loops));
  }

 private:
  bool IsKept(int vertex) const { return above_[vertex] <= kThinnest; }
  bool IsBelow(int vertex) const { return above_[vertex] < -kThinnest; }

  int NumberOf(int vertex) {
    if (number_[vertex] < 0) {
      number_[vertex] = static_cast<int>(vertices_.size());
      vertices_.push_back(solid_.vertices[vertex]);
    }
    return number_[vertex];
  }

  // Returns the point where an edge crosses the plane. Both facets of the edge get the same point.
  int Crossing(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [found, is_new] = crossings_.try_emplace({a, b}, static_cast<int>(vertices_.size()));
    if (is_new) {
      const double share = above_[a] / (above_[a] - above_[b]);
      vertices_.push_back(solid_.vertices[a] + share * (solid_.vertices[b] - solid_.vertices[a]));
    }
    return found->second;
  }

  // Returns what remains of a facet. It is empty for a facet that only touches the plane.
  Loop Kept(const Loop& facet) {
    if (std::ranges::none_of(facet, [&](int vertex) { return IsBelow(vertex); })) return {};
    Loop kept;
    for (std::size_t i = 0; i < facet.size(); ++i) {
      const int here = facet[i];
      const int next = facet[(i + 1) % facet.size()];
      if (IsKept(here)) kept.push_back(NumberOf(here));
      const bool crosses = (IsBelow(here) && !IsKept(next)) || (!IsKept(here) && IsBelow(next));
      if (crosses) kept.push_back(Crossing(here, next));
    }
    return kept;
  }

  // Returns the facet that closes the other facets. Each edge of a closed surface occurs once in
  // each direction, so the new facet has the reverse of every edge that occurs only once.
  static Loop Cap(const std::vector<Loop>& loops) {
    std::map<int, int> next;  // along the cap
    std::map<std::pair<int, int>, bool> has;
    for (const Loop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        has[{loop[i], loop[(i + 1) % loop.size()]}] = true;
      }
    }
    for (const auto& [edge, is_there] : has) {
      if (!has.contains({edge.second, edge.first})) next[edge.second] = edge.first;
    }
    ASSAY_CHECK(!next.empty(), "a cut that leaves no opening");
    Loop cap;
    for (int vertex = next.begin()->first; cap.size() < next.size(); vertex = next.at(vertex)) {
      cap.push_back(vertex);
    }
    return cap;
  }

  const ConvexHull& solid_;
  const Plane& plane_;
  std::vector<double> above_;
  std::vector<int> number_;  // of each kept vertex of the solid
  std::map<std::pair<int, int>, int> crossings_;
  std::vector<Vector3> vertices_;
};

Plane PlaneOf(const Facet& facet) { return {facet.normal, facet.offset}; }
Plane Reversed(const Plane& plane) { return {-plane.normal, -plane.height}; }

// Volume and its first two moments about a point.
struct SolidMoments {
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();

  // Adds the tetrahedron between the point and a triangle.
  void Add(const Vector3& a, const Vector3& b, const Vector3& c) {
    const double own = a.dot(b.cross(c)) / 6;
    const Vector3 sum = a + b + c;
    volume += own;
    first += own / 4 * sum;
    second += own / 20 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }

  void Add(const ConvexHull& solid, const Vector3& about) {
    for (const Facet& facet : solid.facets) {
      const auto at = [&](std::size_t i) -> Vector3 {
        return solid.vertices[facet.loop[i]] - about;
      };
      for (std::size_t i = 2; i < facet.loop.size(); ++i) Add(at(0), at(i - 1), at(i));
    }
  }
};

}  // namespace

std::optional<ConvexHull> Below(const ConvexHull& solid, const Plane& plane) {
  Cut cut(solid, plane);
  if (cut.KeepsAll()) return solid;
  if (cut.KeepsNothing()) return std::nullopt;
  return cut.Below();
}

std::optional<ConvexHull> Intersection(const ConvexHull& a, const ConvexHull& b) {
  std::optional<ConvexHull> common = a;
  for (const Facet& facet : b.facets) {
    common = Below(*common, PlaneOf(facet));
    if (!common) break;
  }
  return common;
}

std::vector<ConvexHull> Without(const ConvexHull& solid, const ConvexHull& pocket) {
  if (!Intersection(solid, pocket)) return {solid};
  std::vector<Plane> planes;
  for (const Facet& facet : pocket.facets) planes.push_back(PlaneOf(facet));
  const auto beyond = [&](const Plane& plane) {
    const std::optional<ConvexHull> outside = Below(solid, Reversed(plane));
    return outside ? Volume(*outside) : 0;
  };
  std::ranges::stable_sort(planes, std::ranges::greater(), beyond);
  std::vector<ConvexHull> pieces;
  std::optional<ConvexHull> rest = solid;
  for (const Plane& plane : planes) {
    if (std::optional<ConvexHull> outside = Below(*rest, Reversed(plane))) {
      pieces.push_back(*std::move(outside));
    }
    rest = Below(*rest, plane);
    if (!rest) break;
  }
  return pieces;
}

std::vector<ConvexHull> Disjoint(std::span<const ConvexHull> solids) {
  std::vector<ConvexHull> disjoint;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    std::vector<ConvexHull> fresh = {solids[i]};
    for (const ConvexHull& earlier : solids.first(i)) {
      std::vector<ConvexHull> remaining;
      for (const ConvexHull& piece : fresh)
        std::ranges::move(Without(piece, earlier), std::back_inserter(remaining));
      fresh = std::move(remaining);
    }
    std::ranges::move(fresh, std::back_inserter(disjoint));
  }
  return disjoint;
}

std::optional<ConvexHull> Inset(const ConvexHull& solid, double depth) {
  std::optional<ConvexHull> inset = solid;
  for (const Facet& facet : solid.facets) {
    inset = Below(*inset, {facet.normal, facet.offset - depth});
    if (!inset) break;
  }
  return inset;
}

Polygon ShadowBetween(const ConvexHull& solid, double low, double high) {
  std::vector<Vector2> points;
  const auto add_crossing = [&](const Vector3& a, const Vector3& b, double height) {
    if ((a.z() < height) == (b.z() < height) || a.z() == height || b.z() == height) return;
    const double share = (height - a.z()) / (b.z() - a.z());
    points.push_back((a + share * (b - a)).head<2>());
  };
  for (const Vector3& vertex : solid.vertices) {
    if (vertex.z() >= low && vertex.z() <= high) points.push_back(vertex.head<2>());
  }
  for (const Facet& facet : solid.facets) {
    for (std::size_t i = 0; i < facet.loop.size(); ++i) {
      const int a = facet.loop[i];
      const int b = facet.loop[(i + 1) % facet.loop.size()];
      if (a > b) continue;  // the edge belongs to another facet, too
      add_crossing(solid.vertices[a], solid.vertices[b], low);
      if (high > low) add_crossing(solid.vertices[a], solid.vertices[b], high);
    }
  }
  return Hull2(points);
}

MassProperties MassOf(std::span<const ConvexHull> solids, double density) {
  ASSAY_CHECK(!solids.empty() && density > 0);
  const Vector3 about = solids.front().vertices.front();
  SolidMoments moments;
  for (const ConvexHull& piece : Disjoint(solids)) moments.Add(piece, about);
  MassProperties mass;
  mass.mass = density * moments.volume;
  const Vector3 center = moments.first / moments.volume;
  mass.center = about + center;
  const Matrix3 spread = density * (moments.second - moments.volume * center * center.transpose());
  mass.inertia = spread.trace() * Matrix3::Identity() - spread;
  return mass;
}

}  // namespace assay::geometry
