#pragma once

#include <span>

#include "planner/geometry/hull.h"
#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Returns how deep a point is in a convex hull: the least distance to a facet's plane, negative
// outside.
double DepthIn(const geometry::ConvexHull& hull, const Vector3& p);

// Returns the greatest depth of a mesh's surface in a hull, at corners and middles of triangles.
double DepthOf(const TriangleMesh& mesh, const geometry::ConvexHull& hull);

// Returns whether a point is inside of a closed mesh. Points within a millionth of the size from
// the surface may be on either side.
bool IsInside(const TriangleMesh& mesh, const Vector3& p);

// Returns the greatest distance between the surface of a closed mesh and the outer surface of
// convex pieces, measured at the corners and the middles of triangles and facets.
double DistanceBetween(const TriangleMesh& mesh, std::span<const geometry::ConvexHull> pieces);

}  // namespace assay::mesh_import
