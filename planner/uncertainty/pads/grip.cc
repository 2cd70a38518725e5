#include "planner/uncertainty/pads/grip.h"

#include <algorithm>

#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {

// Forces along the closing direction are borne by the pads' pressures, and lower the pressure of
// one pad.
//
// Moments are borne by pressure that moves to an edge of one pad and to the opposite edge of the
// other. If the pads touch in the same places, the two pressures together are then spread wider
// about the same middle, and friction bears no less: its power in a motion is a convex function of
// the place. If they touch in different places, the friction of the pressure that moves counts for
// nothing.
double Grip::RatioOf(const GripLoad& load, double force) const {
  const double pressing = force - load.across / 2;
  const double arm = 2 * reach.minCoeff();
  if (!(pressing > 0) || !(arm > 0)) return kNothingBorne;
  const double tilting = load.tilting / arm;
  const double borne_of = alike ? std::max(load.slipping, tilting) : load.slipping + tilting;
  return std::min(kNothingBorne, borne_of / pressing);
}

Grip GripOf(const domain::Problem& problem, PartId part, const plan::Hold& hold,
            const OffInHand& off) {
  const domain::PartModel& model = *problem.part(part).model;
  const Vector2& pad = problem.workcell->gripper().pad_half_extents();
  const Vector2 cell = pad / kCellsPerSide;
  const std::vector<Vector2> left = TouchingCells(model, hold, 1, pad, off);
  const std::vector<Vector2> right = TouchingCells(model, hold, -1, pad, off);
  if (left.empty() || right.empty()) return {};
  const double friction = problem.workcell->rules().pad_friction - problem.tolerances.pad_friction;
  std::vector<PadCell> cells;
  Vector2 low = left.front();
  Vector2 high = left.front();
  for (const std::vector<Vector2>* side : {&left, &right}) {
    if (side == &right && left == right) continue;
    const double share = friction / static_cast<double>(side->size());
    for (const Vector2& at : *side) {
      cells.push_back({at, left == right ? 2 * share : share});
      low = low.cwiseMin(at - cell);
      high = high.cwiseMax(at + cell);
    }
  }
  PadFriction pads(std::move(cells));
  const Vector2 reach = (high - pads.center()).cwiseMin(pads.center() - low);
  return {std::move(pads), reach, left == right};
}

PlaneLoad ActingAt(const Vector2& lever, const Vector2& force) {
  return {.force = force, .torsion = lever.x() * force.y() - lever.y() * force.x()};
}

}  // namespace assay::uncertainty
