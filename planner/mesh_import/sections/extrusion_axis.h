#pragma once

#include <vector>

#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Returns directions along which the shape of a mesh may have been extruded, the most likely first.
// Most of the surface of such a mesh is parallel to its direction of extrusion or at right angles
// to it. A direction that is within 0.001 rad of an axis of the frame is that axis.
std::vector<Vector3> ExtrusionAxes(const TriangleMesh& mesh);

// Returns the frame in which z is the axis of extrusion, as columns, and x and y are along most of
// the sides, if most sides are at right angles. The frame is right-handed. If its axes are those of
// the mesh in another order, except for rounding, they are exactly those of the mesh.
Matrix3 FrameOfExtrusion(const TriangleMesh& mesh, const Vector3& axis);

}  // namespace assay::mesh_import
