#pragma once

#include "planner/domain/parts/part_model.h"
#include "planner/plan/data/plan.h"
#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

using geometry::Vector2;

// The greatest error of a held part in the hand: metres along the tool's axes, and radians.
struct OffInHand {
  Vector3 shift = Vector3::Zero();
  double turn = 0;     // about all axes together
  bool rolls = false;  // true if the part is round about the tool's z (HeldError::is_round)
  double rolled = 0;   // what of the turn is about the axis of such a part
};
OffInHand OffInHandOf(const UncertainWorld& world, const HeldError& held);

// Cells on which a pad surely touches its face, for any error of the part in the hand.
struct TouchingCells {
  std::vector<Vector2> middles;    // in the tool's x and z
  Vector2 half = Vector2::Zero();  // half the extents of a cell
};

// The number of cells along each side of a pad, or of a patch.
inline constexpr int kCellsPerSide = 6;

// Returns the touching cells of a pad. `side` is 1 or -1 and says on which side along the tool's y
// the pad is; `pad` is its half extents. Pads that lie wholly on their faces are divided into
// cells. Otherwise the region that both of them touch opposite each other is divided into cells,
// which are fixed to the part. A round part that may have rolled touches along a line, which is
// divided.
TouchingCells TouchingCellsOf(const domain::PartModel& model, const plan::Hold& hold, double side,
                              const Vector2& pad, const OffInHand& off);

}  // namespace assay::uncertainty
