#include "planner/geometry/solids/convex_cut.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "planner/base/check.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"

namespace assay::geometry {
namespace {

constexpr double kThinnest = 1e-9;  // metres

using Loop = std::vector<int>;

// Sorts vertices by height, then by y and x, and facets by their loops. The order then does not
// depend on the cuts that a solid comes from.
void SortVertices(ConvexHull& hull) {
  std::vector<int> order(hull.vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int i) {
    const Vector3& p = hull.vertices[i];
    const auto rounded = [](double x) { return std::llround(x / kThinnest); };
    return std::tuple(rounded(p.z()), rounded(p.y()), rounded(p.x()));
  });
  std::vector<Vector3> vertices;
  std::vector<int> number(order.size());
  for (const int old : order) {
    number[old] = static_cast<int>(vertices.size());
    vertices.push_back(hull.vertices[old]);
  }
  hull.vertices = std::move(vertices);
  for (Facet& facet : hull.facets) {
    for (int& vertex : facet.loop) vertex = number[vertex];
    std::ranges::rotate(facet.loop, std::ranges::min_element(facet.loop));
  }
  std::ranges::sort(hull.facets, {}, &Facet::loop);
}

// One cut of a solid by a plane. Vertices within kThinnest of the plane count as on it.
class Cut {
 public:
  Cut(const ConvexHull& solid, const Plane& plane) : solid_(solid), plane_(plane) {
    for (const Vector3& vertex : solid.vertices) above_.push_back(plane.Above(vertex));
    number_.assign(solid.vertices.size(), -1);
  }

  bool KeepsAll() const { return std::ranges::max(above_) <= kThinnest; }
  bool KeepsNothing() const { return std::ranges::min(above_) >= -kThinnest; }

  // Facets keep their planes, so that cuts do not add up rounding errors.
  ConvexHull Below() {
    ConvexHull rest;
    std::vector<Loop> loops;
    for (const Facet& facet : solid_.facets) {
      Loop loop = Kept(facet.loop);
      if (loop.size() < 3) continue;
      loops.push_back(loop);
      rest.facets.push_back({facet.normal, facet.offset, std::move(loop)});
    }
    rest.facets.push_back({plane_.normal, plane_.height, Cap(loops)});
    rest.vertices = std::move(vertices_);
    SortVertices(rest);
    return rest;
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

// Returns the planes of a pocket's sides in the order of cutting. Opposite sides are neighbours,
// and pairs with less of the solid's matter beyond them come first.
std::vector<Plane> CutOrder(const ConvexHull& solid, const ConvexHull& pocket) {
  constexpr double kOpposite = 1e-9;
  std::vector<std::vector<Plane>> groups;
  for (const Facet* const facet : FacetsByAxis(pocket)) {
    const auto opposite = std::ranges::find_if(groups, [&](const std::vector<Plane>& group) {
      return (group.front().normal + facet->normal).norm() < kOpposite;
    });
    const auto group = opposite != groups.end() ? opposite : groups.insert(groups.end(), {{}});
    group->push_back(PlaneOf(*facet));
  }
  std::ranges::stable_sort(groups, {}, [&](const std::vector<Plane>& group) {
    return std::ranges::count_if(
        group, [&](const Plane& plane) { return Below(solid, Reversed(plane)).has_value(); });
  });
  std::vector<Plane> planes;
  for (const std::vector<Plane>& group : groups)
    std::ranges::copy(group, std::back_inserter(planes));
  return planes;
}

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
  std::vector<ConvexHull> pieces;
  std::optional<ConvexHull> rest = solid;
  for (const Plane& plane : CutOrder(solid, pocket)) {
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

}  // namespace assay::geometry
