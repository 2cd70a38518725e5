#pragma once

#include "planner/uncertainty/pads/pad_friction.h"
#include "planner/uncertainty/pads/touching_cells.h"

namespace assay::uncertainty {

// The load on a part between two pads.
struct GripLoad {
  // load in the plane of the pads, divided by what one newton on each pad bears
  double slipping = 0;
  double across = 0;   // force along the closing direction, newtons
  double tilting = 0;  // moment about the axes in the plane of the pads, newton metres
};

// The hold of two pads on a part: their least friction, on the patches where they surely touch, per
// newton on each pad.
struct Grip {
  PadFriction friction{{}};
  bool touches = false;  // true if both pads surely touch
  // Least distance from the center of friction to the patch's edges, along each axis, metres.
  Vector2 reach = Vector2::Zero();
  bool alike = false;  // true if both pads touch in the same places
  // The moment about an axis in the plane of the pads that their friction bears alone, by opposite
  // forces, for each newton on each pad, metres. 0 if it does not count.
  double couple = 0;
  // The share of the friction that keeps a round part from turning between the pads until one of
  // its faces lies flat.
  double wedging = 0;

  // Returns the ratio of the load to what the pads bear when each presses with `force` newtons. If
  // the ratio is below 1, the pads hold the part. If a pad may touch nothing, the pads bear
  // nothing.
  double RatioOf(const GripLoad& load, double force) const;
};
Grip GripOf(const domain::Problem& problem, PartId part, const plan::Hold& hold,
            const OffInHand& off);

// Returns the friction between the pads and a part, within its tolerance.
Interval PossiblePadFriction(const domain::Problem& problem);

// Returns the force in the plane of the pads (newtons), and the torsion that it causes by acting at
// `lever` (metres) from the center of friction.
PlaneLoad ActingAt(const Vector2& lever, const Vector2& force);

}  // namespace assay::uncertainty
