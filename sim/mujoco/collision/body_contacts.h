#pragma once

#include <vector>

#include "sim/mujoco/collision/convex_pieces.h"

struct mjModel_;
struct mjData_;

namespace assay::mujoco {

// Returns the contacts of two bodies in which meshes take part: those of geometry::ContactBetween
// for each pair of their geoms that collide, without contacts inside a body (inner_faces.h). Where
// bodies of many pieces lie on each other, the pieces touch at each crossing of their seams. Only
// the outermost contacts in one plane are kept. The contacts between them bear no load that the
// outermost ones cannot bear.
std::vector<PieceContact> ContactsOfBodies(const mjModel_& m, const mjData_& d,
                                           const ConvexPieces& pieces, int body1, int body2);

}  // namespace assay::mujoco
