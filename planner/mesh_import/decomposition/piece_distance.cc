#include "planner/mesh_import/decomposition/piece_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/geometry/hull.h"
#include "planner/mesh_import/meshes/nearest_surface.h"

namespace assay::mesh_import {
namespace {

using geometry::ConvexHull;
using geometry::Facet;

// Calls `visit` with the corners and the middles of the triangles of a mesh.
template <class Visit>
void ForSurfacePoints(const TriangleMesh& mesh, const Visit& visit) {
  for (const Vector3& vertex : mesh.vertices) visit(vertex);
  for (const Triangle& triangle : mesh.triangles) visit(mesh.Centroid(triangle));
}

std::vector<Vector3> PointsOf(const ConvexHull& hull) {
  std::vector<Vector3> points = hull.vertices;
  for (const Facet& facet : hull.facets) {
    Vector3 middle = Vector3::Zero();
    const Vector3* last = &hull.vertices[static_cast<std::size_t>(facet.loop.back())];
    for (const int i : facet.loop) {
      const Vector3& vertex = hull.vertices[static_cast<std::size_t>(i)];
      middle += vertex / static_cast<double>(facet.loop.size());
      points.push_back((vertex + *last) / 2);
      last = &vertex;
    }
    points.push_back(middle);
  }
  return points;
}

}  // namespace

double DepthIn(const ConvexHull& hull, const Vector3& p) {
  double depth = std::numeric_limits<double>::infinity();
  for (const Facet& facet : hull.facets)
    depth = std::min(depth, facet.offset - facet.normal.dot(p));
  return depth;
}

double DepthOf(const TriangleMesh& mesh, const ConvexHull& hull) {
  double depth = 0;
  ForSurfacePoints(mesh, [&](const Vector3& p) { depth = std::max(depth, DepthIn(hull, p)); });
  return depth;
}

// A line from the point along z crosses the surface an odd number of times. It is moved aside a
// little, so that it does not meet edges of meshes with regular coordinates.
bool IsInside(const TriangleMesh& mesh, const Vector3& point) {
  const Vector3 p = point + mesh.Size() * Vector3(1.3e-7, 2.7e-7, 0);
  bool inside = false;
  for (const Triangle& triangle : mesh.triangles) {
    int winding = 0;
    for (int k = 0; k < 3; ++k) {
      const Vector3& a = mesh.Corner(triangle, k);
      const Vector3& b = mesh.Corner(triangle, (k + 1) % 3);
      if ((a.y() > p.y()) == (b.y() > p.y())) continue;
      if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) ++winding;
    }
    if (winding % 2 == 0) continue;
    const Vector3 normal = mesh.AreaVector(triangle);
    if (normal.z() == 0) continue;
    const double above = normal.dot(mesh.Corner(triangle, 0) - p) / normal.z();
    if (above > 0) inside = !inside;
  }
  return inside;
}

double DistanceBetween(const TriangleMesh& mesh, std::span<const ConvexHull> pieces) {
  std::vector<Eigen::AlignedBox3d> bounds(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const Vector3& vertex : pieces[i].vertices) bounds[i].extend(vertex);
  }
  double greatest = 0;
  ForSurfacePoints(mesh, [&](const Vector3& p) {
    double depth = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (bounds[i].exteriorDistance(p) < std::max(-depth, 0.0) || bounds[i].contains(p))
        depth = std::max(depth, DepthIn(pieces[i], p));
    }
    greatest = std::max(greatest, std::abs(depth));
  });
  const NearestSurface surface(mesh);
  for (const ConvexHull& piece : pieces) {
    for (const Vector3& p : PointsOf(piece)) {
      const double distance = surface.To(p).distance;
      if (distance > greatest && !IsInside(mesh, p)) greatest = distance;
    }
  }
  return greatest;
}

}  // namespace assay::mesh_import
