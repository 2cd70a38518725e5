#pragma once

#include "sim/mujoco/collision/convex_pieces.h"

struct mjModel_;
struct mjData_;

namespace assay::mujoco {

// Returns whether a contact of two geoms is inside of one of their bodies: whether the way out
// along its normal leads through a facet that other pieces of the body cover there. Where pieces of
// one body lie against each other, their facets, edges and corners are not part of the body's
// surface. A part that slides over such pieces and sinks in by a micrometre would otherwise be
// stopped by the end of the next piece.
bool IsInsideBody(const mjModel_& m, const mjData_& d, const ConvexPieces& pieces,
                  const PieceContact& contact);

}  // namespace assay::mujoco
