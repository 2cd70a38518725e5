#pragma once

#include "planner/uncertainty/preconditions/pad_friction.h"
#include "planner/uncertainty/preconditions/touching_cells.h"

namespace assay::uncertainty {

// What acts on a part between two pads.
struct GripLoad {
  double slipping = 0;  // in the plane of the pads, over what one newton on each of them bears
  double across = 0;    // along the closing direction, newtons
  double tilting = 0;   // moment about the axes in the plane of the pads, newton metres
};

// How two pads hold a part, with the least of their friction, where they surely touch. Per newton
// on each of them.
struct Grip {
  PadFriction friction{{}};
  Vector2 reach = Vector2::Zero();  // of the pressure from the center of friction, in any sense
  bool alike = false;               // whether both touch in the same places

  // The load over what the pads bear when each presses with `force` newtons: below 1 they hold.
  // Nothing is borne where a pad may touch nothing.
  double RatioOf(const GripLoad& load, double force) const;
};
Grip GripOf(const domain::Problem& problem, PartId part, const plan::Hold& hold,
            const OffInHand& off);

// The force in the plane of the pads, and the torsion that it has by acting at `lever` from the
// center of friction.
PlaneLoad ActingAt(const Vector2& lever, const Vector2& force);

}  // namespace assay::uncertainty
