#pragma once

#include <vector>

#include "planner/mesh_import/meshes/plane_cut.h"

namespace assay::mesh_import {

// Returns planes by which a closed mesh may be cut to make it convex: those of the triangles beside
// its longest concave edges, and three through its middle. There are at most 11 planes. Their field
// `tolerance` is 0.
std::vector<CutPlane> ConcavePlanesOf(const TriangleMesh& mesh);

}  // namespace assay::mesh_import
