#pragma once

#include "planner/domain/part/part_model.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/errors/uncertain_world.h"

namespace assay::uncertainty {

using geometry::Vector2;

// By how much what is held may be off in the hand: metres along the tool's axes, and radians.
struct OffInHand {
  Vector3 shift = Vector3::Zero();
  double turn = 0;
};
OffInHand OffInHandOf(const UncertainWorld& world, const HeldError& held);

// A pad is looked at in so many cells along each of its sides.
inline constexpr int kCellsPerSide = 6;

// Where a pad surely touches its face, whatever the part is off in the hand: middles of cells, in
// the tool's x and z. `side`: 1 or -1, of the pad, along the tool's y; `pad`: its half extents.
std::vector<Vector2> TouchingCells(const domain::PartModel& model, const plan::Hold& hold,
                                   double side, const Vector2& pad, const OffInHand& off);

}  // namespace assay::uncertainty
