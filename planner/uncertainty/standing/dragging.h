#pragma once

#include <vector>

#include "planner/uncertainty/error_sets/uncertain_world.h"

namespace assay::uncertainty {

// The greatest movement of a part that a mating drags along.
struct Drag {
  PartId part;
  double way = 0;   // of the part's origin, metres, along x and along y each
  double turn = 0;  // radians, about the vertical
};

// Returns the parts that a straight mating may drag along, the fixed part first. The result is
// empty if the mating drags nothing. A held part moves when it lands leaning in its seat, or when
// it yields to the seat's walls. It drags the fixed part by the same distance if friction between
// the two exceeds the friction that keeps the fixed part, or a part under it, in its place
// (SlidingRatio). The fixed part then moves everything that may touch it: what stands on it or is
// mated with it, what it stands on, and neighbours. (Paper mode leaves all this out.)
std::vector<Drag> DragsOf(const UncertainWorld& world, domain::MatingId mating,
                          const plan::Hold& hold, const ManipulatorError& draw);
// Returns the movement of the fixed part alone.
Drag DragOfFixed(const UncertainWorld& world, domain::MatingId mating, const plan::Hold& hold,
                 const ManipulatorError& draw);
// Returns the greatest distance, along x and along y each, by which any point of a part moves that
// is dragged like this; 0 if the part is not among those that are dragged.
double ReachOfDrag(const domain::Problem& problem, const std::vector<Drag>& drags, PartId part);
// Adds these movements to the errors of the parts.
void DragAlong(UncertainWorld& world, const std::vector<Drag>& drags);

}  // namespace assay::uncertainty
