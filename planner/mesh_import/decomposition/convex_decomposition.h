#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planner/geometry/hull.h"
#include "planner/mesh_import/meshes/triangle_mesh.h"

namespace assay::mesh_import {

// Returns the hull of at most about `most` of the points, those that lie farthest in evenly spread
// directions. Returns none if the points are nearly flat.
std::optional<geometry::ConvexHull> HullOfExtremes(std::span<const Vector3> points, int most);

double VolumeOf(const geometry::ConvexHull& hull);

struct DecompositionRules {
  double depth = 0;      // surface may lie so deep in the pieces, metres
  int most_pieces = 32;  // the deepest places are cut first
};

struct Decomposition {
  std::vector<geometry::ConvexHull> pieces;
  double volume_share = 0;  // of the mesh's volume, by which the pieces are greater together
  double distance = 0;      // greatest distance between the surfaces of mesh and pieces, metres
};

// Covers a closed mesh with convex pieces: cuts it by planes through concave edges, so that the
// hulls of the parts are as small as possible together, and cuts the parts again. (An approximate
// convex decomposition as of Lien and Amato 2007, with Mamou and Ghorbel's (2009) measure of
// concavity.) The result has at least one piece.
Decomposition Decompose(const TriangleMesh& mesh, const DecompositionRules& rules);

}  // namespace assay::mesh_import
