#include "planner/finemotion/contacts/polyhedron.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <ranges>
#include <tuple>
#include <utility>

#include "planner/geometry/hull.h"
#include "planner/geometry/outline.h"

namespace assay::finemotion {
namespace {

using geometry::ConvexHull;
using geometry::Halves;
using geometry::Outline;
using geometry::Plane;
using geometry::Segment;

// Two directions that differ by less than this (radians) count as one, and a corner that turns by
// less than this counts as flat.
constexpr double kFlat = 1e-6;
constexpr double kUnionTolerance = 1e-7;  // metres

// A convex piece, with the plane of each of its facets.
struct Solid {
  ConvexHull hull;
  std::vector<int> planes;  // for each facet, the index of its plane
};

Outline OutlineOf(const ConvexHull& hull, const geometry::Facet& facet) {
  Outline outline;
  for (int i : facet.loop) outline.push_back(hull.vertices[i]);
  return outline;
}

// The union of convex pieces. Its shape near a point depends on the pieces that contain the point.
// The point is on an outer feature if all of them lie on one side of a plane through it.
class Union {
 public:
  explicit Union(const std::vector<ConvexPiece>& pieces) {
    for (const ConvexPiece& piece : pieces) {
      Solid solid{geometry::HullOf(piece.corners), {}};
      for (const geometry::Facet& facet : solid.hull.facets) {
        solid.planes.push_back(PlaneOf(OutlineOf(solid.hull, facet), facet));
      }
      solids_.push_back(std::move(solid));
    }
  }

  Polyhedron Outside() const;

 private:
  using PlanePair = std::pair<int, int>;

  int PlaneOf(const Outline& outline, const geometry::Facet& facet);
  double HighestAbove(const Plane& plane, const Solid& solid) const;
  bool Supports(const Plane& plane, const std::vector<int>& solids) const;
  std::vector<int> Containing(const Vector3& p) const;

  bool Covers(int cover, int solid, int plane) const;
  std::vector<Outline> Without(const std::vector<Outline>& region, const Solid& cover) const;
  std::vector<Outline> Exposed(int plane) const;

  std::vector<Vector3> CutPoints(const Segment& edge) const;
  PlanePair ConvexAt(const Vector3& p) const;
  std::map<PlanePair, std::vector<Segment>> ConvexStretches() const;
  std::vector<Segment> Joined(std::vector<Segment> stretches, PlanePair planes) const;

  bool IsConvexCorner(const Vector3& p, const std::vector<Vector3>& leaving) const;

  void AddFaces(Polyhedron& outside, std::vector<int>& plane_of_face) const;
  void AddEdges(Polyhedron& outside, const std::vector<int>& plane_of_face) const;
  void AddVertices(Polyhedron& outside) const;

  std::vector<Solid> solids_;
  std::vector<Plane> planes_;      // planes of all facets, each once
  std::vector<Outline> outlines_;  // for each plane, the outline of the first facet in it
};

constexpr std::pair<int, int> kNotConvex = {-1, -1};

// Returns the index of the facet's plane. A facet is in a known plane if neither leaves the plane
// of the other by more than the tolerance.
int Union::PlaneOf(const Outline& outline, const geometry::Facet& facet) {
  const Plane plane = {facet.normal, facet.offset};
  const auto on = [&](const Plane& other) {
    return [&](const Vector3& p) { return std::abs(other.Above(p)) <= kUnionTolerance; };
  };
  for (int i = 0; i < static_cast<int>(planes_.size()); ++i) {
    if (planes_[i].normal.dot(plane.normal) > 0 && std::ranges::all_of(outline, on(planes_[i])) &&
        std::ranges::all_of(outlines_[i], on(plane))) {
      return i;
    }
  }
  planes_.push_back(plane);
  outlines_.push_back(outline);
  return static_cast<int>(planes_.size()) - 1;
}

double Union::HighestAbove(const Plane& plane, const Solid& solid) const {
  double highest = -std::numeric_limits<double>::infinity();
  for (const Vector3& p : solid.hull.vertices) highest = std::max(highest, plane.Above(p));
  return highest;
}

// Returns whether all these solids lie below the plane.
bool Union::Supports(const Plane& plane, const std::vector<int>& solids) const {
  return std::ranges::all_of(
      solids, [&](int s) { return HighestAbove(plane, solids_[s]) <= kUnionTolerance; });
}

std::vector<int> Union::Containing(const Vector3& p) const {
  std::vector<int> containing;
  for (int s = 0; s < static_cast<int>(solids_.size()); ++s) {
    const auto has_below = [&](int plane) { return planes_[plane].Above(p) <= kUnionTolerance; };
    if (std::ranges::all_of(solids_[s].planes, has_below)) containing.push_back(s);
  }
  return containing;
}

// Returns whether the solid `cover` hides that region of a facet of `solid` which lies in `cover`.
// The facet is in the plane. If two facets lie in one plane, the facet of the earlier solid hides
// the other.
bool Union::Covers(int cover, int solid, int plane) const {
  if (cover == solid) return false;
  if (HighestAbove(planes_[plane], solids_[cover]) > kUnionTolerance) return true;
  const std::vector<int>& its_planes = solids_[cover].planes;
  return cover < solid && std::ranges::find(its_planes, plane) != its_planes.end();
}

std::vector<Outline> Union::Without(const std::vector<Outline>& region, const Solid& cover) const {
  std::vector<Outline> left;
  for (const Outline& outline : region) {
    std::vector<Outline> cut_off;
    Outline rest = outline;
    for (int plane : cover.planes) {
      Halves halves = Split(rest, planes_[plane], kUnionTolerance);
      if (geometry::IsBroad(halves.above, kUnionTolerance))
        cut_off.push_back(std::move(halves.above));
      rest = std::move(halves.below);
    }
    // If nothing is covered, the polygon stays whole.
    if (!geometry::IsBroad(rest, kUnionTolerance)) cut_off = {outline};
    std::ranges::move(cut_off, std::back_inserter(left));
  }
  return left;
}

std::vector<Outline> Union::Exposed(int plane) const {
  std::vector<Outline> exposed;
  for (int s = 0; s < static_cast<int>(solids_.size()); ++s) {
    const Solid& solid = solids_[s];
    for (std::size_t f = 0; f < solid.planes.size(); ++f) {
      if (solid.planes[f] != plane) continue;
      std::vector<Outline> region = {OutlineOf(solid.hull, solid.hull.facets[f])};
      for (int cover = 0; cover < static_cast<int>(solids_.size()); ++cover) {
        if (Covers(cover, s, plane)) region = Without(region, solids_[cover]);
      }
      std::ranges::move(region, std::back_inserter(exposed));
    }
  }
  return exposed;
}

// Returns the points where planes of the pieces cross the edge, in order, with the edge's start and
// end.
std::vector<Vector3> Union::CutPoints(const Segment& edge) const {
  std::vector<double> fractions;
  for (const Plane& plane : planes_) {
    const double at_start = plane.Above(edge.start);
    const double at_end = plane.Above(edge.end);
    if (std::min(at_start, at_end) < -kUnionTolerance &&
        std::max(at_start, at_end) > kUnionTolerance) {
      fractions.push_back(at_start / (at_start - at_end));
    }
  }
  std::ranges::sort(fractions);
  std::vector<Vector3> points = {edge.start};
  for (double fraction : fractions) {
    const Vector3 p = edge.start + fraction * (edge.end - edge.start);
    const bool is_apart =
        (p - points.back()).norm() > kUnionTolerance && (p - edge.end).norm() > kUnionTolerance;
    if (is_apart) points.push_back(p);
  }
  points.push_back(edge.end);
  return points;
}

// Returns the two planes of the union's convex edge through p, the lower index first, or
// kNotConvex. p must be inside an edge of a piece. A convex edge needs two planes through p that
// have all pieces at p below them. With only one such plane, the edge is a seam or concave.
Union::PlanePair Union::ConvexAt(const Vector3& p) const {
  const std::vector<int> here = Containing(p);
  std::vector<int> supporting;
  for (int s : here) {
    for (int plane : solids_[s].planes) {
      if (std::abs(planes_[plane].Above(p)) > kUnionTolerance) continue;
      if (Supports(planes_[plane], here)) supporting.push_back(plane);
    }
  }
  PlanePair sharpest = kNotConvex;
  double least_cosine = std::numeric_limits<double>::infinity();
  for (int a : supporting) {
    for (int b : supporting) {
      const double cosine = planes_[a].normal.dot(planes_[b].normal);
      if (a >= b || cosine >= least_cosine) continue;
      if (planes_[a].normal.cross(planes_[b].normal).norm() < kFlat) continue;
      sharpest = {a, b};
      least_cosine = cosine;
    }
  }
  return sharpest;
}

// Returns the convex stretches of the pieces' edges, by pair of planes. Between two cut points an
// edge is convex everywhere or nowhere, so its middle decides.
std::map<Union::PlanePair, std::vector<Segment>> Union::ConvexStretches() const {
  std::map<PlanePair, std::vector<Segment>> stretches;
  const auto add_stretches = [&](const Segment& edge) {
    const std::vector<Vector3> points = CutPoints(edge);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Segment stretch = {points[i - 1], points[i]};
      const PlanePair planes = ConvexAt(stretch.Middle());
      if (planes != kNotConvex) stretches[planes].push_back(stretch);
    }
  };
  for (const Solid& solid : solids_) {
    for (const geometry::Facet& facet : solid.hull.facets) {
      for (std::size_t i = 0; i < facet.loop.size(); ++i) {
        const int start = facet.loop[i];
        const int end = facet.loop[(i + 1) % facet.loop.size()];
        if (start > end) continue;  // the facet on the other side has this edge in the right order
        add_stretches({solid.hull.vertices[start], solid.hull.vertices[end]});
      }
    }
  }
  return stretches;
}

// Joins stretches of the line that two planes share. Stretches that overlap or follow each other
// become one, unless something rises from the point between them.
std::vector<Segment> Union::Joined(std::vector<Segment> stretches, PlanePair planes) const {
  const Plane& first = planes_[planes.first];
  const Plane& second = planes_[planes.second];
  const Vector3 along = first.normal.cross(second.normal).normalized();
  for (Segment& stretch : stretches) {
    if (along.dot(stretch.end - stretch.start) < 0) std::swap(stretch.start, stretch.end);
  }
  std::ranges::stable_sort(stretches, {}, [&](const Segment& s) { return along.dot(s.start); });
  const auto continues = [&](const Segment& before, const Segment& after) {
    const double overlap = along.dot(before.end - after.start);
    if (std::abs(overlap) > kUnionTolerance) return overlap > 0;
    const std::vector<int> here = Containing(before.end);
    return Supports(first, here) && Supports(second, here);
  };
  std::vector<Segment> joined;
  for (const Segment& stretch : stretches) {
    if (joined.empty() || !continues(joined.back(), stretch)) {
      joined.push_back(stretch);
    } else if (along.dot(stretch.end - joined.back().end) > kUnionTolerance) {
      joined.back().end = stretch.end;
    }
  }
  return joined;
}

// Returns whether some plane touches the union near p in p alone. The pieces at p span a cone. Its
// extreme rays are the convex edges that leave p, so each facet of the cone contains two of them.
// If some plane touches the union in p alone, then the plane whose normal is the sum of the facets'
// normals does it, too.
bool Union::IsConvexCorner(const Vector3& p, const std::vector<Vector3>& leaving) const {
  const std::vector<int> here = Containing(p);
  Vector3 outward = Vector3::Zero();
  for (const Vector3& a : leaving) {
    for (const Vector3& b : leaving) {
      const Vector3 normal = a.cross(b);
      if (normal.norm() < kFlat) continue;
      const Plane plane = {normal.normalized(), normal.normalized().dot(p)};
      if (Supports(plane, here)) outward += plane.normal;
    }
  }
  const auto is_below = [&](const Vector3& corner) {
    const double distance = (corner - p).norm();
    return distance <= kUnionTolerance || outward.dot(corner - p) < -kFlat * distance;
  };
  return std::ranges::all_of(
      here, [&](int s) { return std::ranges::all_of(solids_[s].hull.vertices, is_below); });
}

void Union::AddFaces(Polyhedron& outside, std::vector<int>& plane_of_face) const {
  for (int plane = 0; plane < static_cast<int>(planes_.size()); ++plane) {
    const auto& [normal, height] = planes_[plane];
    const std::vector<Outline> region = geometry::Merged(Exposed(plane), normal, kUnionTolerance);
    for (std::vector<Outline>& part : geometry::ConnectedParts(region, kUnionTolerance)) {
      outside.faces.push_back({normal, height, std::move(part)});
      plane_of_face.push_back(plane);
    }
  }
}

void Union::AddEdges(Polyhedron& outside, const std::vector<int>& plane_of_face) const {
  const auto face_at = [&](int plane, const Vector3& p) {
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int f = 0; f < static_cast<int>(plane_of_face.size()); ++f) {
      if (plane_of_face[f] != plane) continue;
      for (const Outline& outline : outside.faces[f].region) {
        const double distance = geometry::DistanceOutside(outline, outside.faces[f].normal, p);
        if (distance < least) std::tie(nearest, least) = std::pair(f, distance);
      }
    }
    return nearest;
  };
  for (const auto& [planes, stretches] : ConvexStretches()) {
    for (const Segment& edge : Joined(stretches, planes)) {
      const int first = face_at(planes.first, edge.Middle());
      const int second = face_at(planes.second, edge.Middle());
      const bool is_feature = edge.Length() > kUnionTolerance && first >= 0 && second >= 0;
      if (is_feature) outside.edges.push_back({edge.start, edge.end, {first, second}});
    }
  }
}

void Union::AddVertices(Polyhedron& outside) const {
  std::vector<OuterVertex> ends;
  const auto add_end = [&](const Vector3& p, int edge) {
    auto end = std::ranges::find_if(
        ends, [&](const OuterVertex& other) { return (other.p - p).norm() <= kUnionTolerance; });
    if (end == ends.end()) end = ends.insert(end, {p, {}});
    end->edges.push_back(edge);
  };
  for (int e = 0; e < static_cast<int>(outside.edges.size()); ++e) {
    add_end(outside.edges[e].start, e);
    add_end(outside.edges[e].end, e);
  }
  for (OuterVertex& end : ends) {
    std::vector<Vector3> leaving;
    for (int e : end.edges) {
      const OuterEdge& edge = outside.edges[e];
      const bool starts_here = (edge.start - end.p).norm() <= kUnionTolerance;
      leaving.push_back(starts_here ? edge.direction() : Vector3(-edge.direction()));
    }
    if (IsConvexCorner(end.p, leaving)) outside.vertices.push_back(std::move(end));
  }
}

Polyhedron Union::Outside() const {
  Polyhedron outside;
  std::vector<int> plane_of_face;
  AddFaces(outside, plane_of_face);
  AddEdges(outside, plane_of_face);
  AddVertices(outside);
  return outside;
}

}  // namespace

Polyhedron OutsideOf(const std::vector<ConvexPiece>& pieces) { return Union(pieces).Outside(); }

Polyhedron Transformed(Polyhedron shape, const Pose& X_NewOld) {
  for (OuterFace& face : shape.faces) {
    face.normal = X_NewOld.linear() * face.normal;
    face.height += face.normal.dot(X_NewOld.translation());
    for (std::vector<Vector3>& outline : face.region) {
      for (Vector3& corner : outline) corner = X_NewOld * corner;
    }
  }
  for (OuterEdge& edge : shape.edges) {
    edge.start = X_NewOld * edge.start;
    edge.end = X_NewOld * edge.end;
  }
  for (OuterVertex& vertex : shape.vertices) vertex.p = X_NewOld * vertex.p;
  for (RoundShaft& shaft : shape.shafts) {
    shaft.tip = X_NewOld * shaft.tip;
    shaft.axis = X_NewOld.linear() * shaft.axis;
  }
  for (RoundHole& hole : shape.holes) {
    hole.mouth = X_NewOld * hole.mouth;
    hole.axis = X_NewOld.linear() * hole.axis;
  }
  return shape;
}

}  // namespace assay::finemotion
