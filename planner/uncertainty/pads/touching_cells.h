#pragma once

#include "planner/domain/parts/part_model.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

using geometry::Vector2;

// The greatest error of a held part in the hand: metres along the tool's axes, and radians.
struct OffInHand {
  Vector3 shift = Vector3::Zero();
  double turn = 0;
};
OffInHand OffInHandOf(const UncertainWorld& world, const HeldError& held);

// The number of cells along each side of a pad.
inline constexpr int kCellsPerSide = 6;

// Returns the middles of the cells on which a pad surely touches its face, for any error of the
// part in the hand. They are in the tool's x and z. `side` is 1 or -1 and says on which side along
// the tool's y the pad is; `pad` is its half extents.
std::vector<Vector2> TouchingCells(const domain::PartModel& model, const plan::Hold& hold,
                                   double side, const Vector2& pad, const OffInHand& off);

}  // namespace assay::uncertainty
