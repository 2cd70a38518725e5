#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/geometry/coordinates.h"

namespace assay::geometry {

struct Box;

// A planar facet of a convex hull.
struct Facet {
  Vector3 normal;         // unit, outward
  double offset = 0;      // normal . p == offset on the facet
  std::vector<int> loop;  // vertex indices, counter-clockwise seen from outside
};

struct ConvexHull {
  std::vector<Vector3> vertices;
  std::vector<Facet> facets;  // coplanar triangles are merged into one facet
};

// Returns the convex hull of points that span three dimensions (checked). The order of vertices and
// facets depends only on the points. (Qhull: Barber, Dobkin and Huhdanpaa 1996.)
ConvexHull HullOf(std::span<const Vector3> points);
// Returns the convex hull of points that are known up to `tolerance` metres: points that are closer
// to each other than the tolerance count as one point, and points that are closer to a plane or
// line than the tolerance count as points on it.
ConvexHull HullOf(std::span<const Vector3> points, double tolerance);

// Returns whether points extend by at least `thinnest` metres along the direction in which they
// vary least, so that they have a hull.
bool SpanSpace(std::span<const Vector3> points, double thinnest);

// Returns a hull whose facets are known, without the use of Qhull. Each loop lists the vertices of
// a facet counter-clockwise, seen from outside.
ConvexHull HullWith(std::vector<Vector3> vertices, std::vector<std::vector<int>> loops);
ConvexHull HullOf(const Box& box);
std::vector<ConvexHull> HullsOf(std::span<const Box> boxes);
// Returns the box that has exactly this shape, up to a nanometre. Returns none for other shapes.
// Overlaps of boxes are decided faster, and the physics engine has a better contact for them.
std::optional<Box> AsBox(const ConvexHull& hull);

ConvexHull Transformed(const ConvexHull& hull, const Pose& X_NewFrame);
std::vector<ConvexHull> Transformed(std::span<const ConvexHull> hulls, const Pose& X_NewFrame);

// Returns true if p is inside the hull, or at most `tolerance` beyond the plane of a facet. A
// negative tolerance requires p to be at least that deep inside.
bool Contains(const ConvexHull& hull, const Vector3& p, double tolerance);
// Returns the greatest value of direction . p for the points of the hull.
double GreatestAlong(const ConvexHull& hull, const Vector3& direction);
// Returns the least extent of the hull along the normal of a facet.
double ThicknessOf(const ConvexHull& hull);
// Returns the height of the lowest vertex over the plane z = 0 of the hulls' frame.
double LowestPoint(std::span<const ConvexHull> hulls);
std::vector<Vector3> VerticesOf(std::span<const ConvexHull> hulls);
// Returns unit vectors such that each edge is parallel to exactly one of them.
std::vector<Vector3> EdgeDirections(const ConvexHull& hull);
// Returns the facets sorted by the axis of the frame that their normals are nearest to, those
// against the axis before those along it. The sides of a box that is aligned with the axes come in
// the order -x, +x, -y, +y, -z, +z.
std::vector<const Facet*> FacetsByAxis(const ConvexHull& hull);

struct Ball {
  Vector3 center = Vector3::Zero();
  double radius = 0;
};
// Returns a ball around points, about the middle of their bounds.
Ball BallAround(std::span<const Vector3> points);

}  // namespace assay::geometry
