#include "planner/geometry/contact/contact_solid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include "planner/geometry/hull.h"

namespace assay::geometry {
namespace {

using Ends = std::pair<int, int>;

// Returns the facet to which each side belongs. A side is given by its first and its last vertex,
// in the direction of the facet's loop.
std::map<Ends, int> SidesOf(const ConvexHull& hull) {
  std::map<Ends, int> sides;
  for (std::size_t f = 0; f < hull.facets.size(); ++f) {
    const std::vector<int>& loop = hull.facets[f].loop;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      sides[{loop[i], loop[(i + 1) % loop.size()]}] = static_cast<int>(f);
    }
  }
  return sides;
}

// Returns the facet besides `own` on whose plane both ends of a side lie best.
int FacetBeside(const ConvexHull& hull, int own, const Ends& ends) {
  int best = own;
  double least = 0;
  for (int f = 0; f < static_cast<int>(hull.facets.size()); ++f) {
    if (f == own) continue;
    const Facet& facet = hull.facets[f];
    const auto depth = [&](int i) {
      return std::abs(facet.normal.dot(hull.vertices[i]) - facet.offset);
    };
    const double off = std::max(depth(ends.first), depth(ends.second));
    if (best != own && off >= least) continue;
    best = f;
    least = off;
  }
  return best;
}

// Returns each edge once. Rounding can leave out a corner that is almost in line with others in the
// loop of one facet, but not in the loop of its neighbour. The sides there have no counterpart, and
// each of them becomes an edge.
std::vector<ContactSolid::Edge> EdgesOf(const ConvexHull& hull) {
  const std::map<Ends, int> sides = SidesOf(hull);
  std::vector<ContactSolid::Edge> edges;
  for (const auto& [ends, left] : sides) {
    const auto other = sides.find({ends.second, ends.first});
    if (other != sides.end() && ends.first > ends.second) continue;
    const int right = other != sides.end() ? other->second : FacetBeside(hull, left, ends);
    edges.push_back({ends.first, ends.second, left, right});
  }
  return edges;
}

std::vector<Plane> BordersOf(const ConvexHull& hull, const Facet& facet) {
  std::vector<Plane> borders;
  for (std::size_t i = 0; i < facet.loop.size(); ++i) {
    const Vector3& start = hull.vertices[facet.loop[i]];
    const Vector3& end = hull.vertices[facet.loop[(i + 1) % facet.loop.size()]];
    const Vector3 outward = (end - start).cross(facet.normal).normalized();
    borders.push_back({outward, outward.dot(start)});
  }
  return borders;
}

ContactSolid::Disc DiscOn(const ConvexHull& hull, const Facet& facet,
                          const std::vector<Plane>& borders) {
  ContactSolid::Disc disc{Vector3::Zero(), std::numeric_limits<double>::infinity()};
  const double count = static_cast<double>(facet.loop.size());
  for (const int vertex : facet.loop) disc.middle += hull.vertices[vertex] / count;
  for (const Plane& border : borders) {
    disc.radius = std::min(disc.radius, -border.Above(disc.middle));
  }
  return disc;
}

}  // namespace

ContactSolid::ContactSolid(ConvexHull solid) : hull(std::move(solid)), edges(EdgesOf(hull)) {
  vertices.resize(static_cast<Eigen::Index>(hull.vertices.size()), 3);
  normals.resize(static_cast<Eigen::Index>(hull.facets.size()), 3);
  directions.resize(static_cast<Eigen::Index>(edges.size()), 3);
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) vertices.row(i) = hull.vertices[i];
  for (Eigen::Index i = 0; i < normals.rows(); ++i) normals.row(i) = hull.facets[i].normal;
  for (Eigen::Index i = 0; i < directions.rows(); ++i) {
    const Vector3 along = hull.vertices[edges[i].end] - hull.vertices[edges[i].start];
    directions.row(i) = along.normalized();
  }
  for (const Facet& facet : hull.facets) {
    borders.push_back(BordersOf(hull, facet));
    discs.push_back(DiscOn(hull, facet, borders.back()));
  }
  middle = vertices.colwise().mean();
}

}  // namespace assay::geometry
