#include "planner/uncertainty/pads/grip.h"

#include <algorithm>
#include <cmath>

#include "planner/uncertainty/pads/contact_patch.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {

// Forces along the closing direction are borne by the pads' pressures, and lower the pressure of
// one pad.
//
// Moments are borne by pressure that moves to an edge of one pad and to the opposite edge of the
// other. If the pads touch in the same places, the two pressures together are then spread wider
// about the same middle, and friction bears no less: its power in a motion is a convex function of
// the place. If they touch in different places, the friction of the pressure that moves counts for
// nothing. On a narrow patch or a line, pressure bears the moment across it, and friction the
// moment about it: the pads' forces are opposite, and act at the same place of each.
double Grip::RatioOf(const GripLoad& load, double force) const {
  const double pressing = force - load.across / 2;
  if (!(pressing > 0) || !touches) return kNothingBorne;
  const double tilting = load.tilting / (2 * reach.minCoeff());
  double borne_of = alike ? std::max(load.slipping, tilting) : load.slipping + tilting;
  if (alike && couple > 0) {
    const double by_friction =
        std::max(load.slipping + load.tilting / couple, load.tilting / (2 * reach.maxCoeff()));
    borne_of = borne_of < by_friction ? borne_of : by_friction;
  }
  return borne_of < kNothingBorne * pressing ? borne_of / pressing + wedging : kNothingBorne;
}

namespace {

// Notes how a round part may touch the pads: at corners that are up to half a face aside of each
// other. The pressures then turn the part, and friction keeps it.
void NoteRoundSide(const domain::PartModel& model, const plan::Hold& hold, const Vector2& pad,
                   const OffInHand& off, double friction, Grip& grip) {
  const auto half_step = RoundAboutApproach(model, hold, pad, pad.y() + off.shift.z());
  grip.touches = half_step.has_value();
  if (half_step) grip.wedging = std::tan(*half_step) / friction;
}

}  // namespace

Interval PossiblePadFriction(const domain::Problem& problem) {
  const double friction = problem.workcell->rules().pad_friction;
  const double tolerance = problem.tolerances.pad_friction;
  return {std::max(0.0, friction - tolerance), friction + tolerance};
}

Grip GripOf(const domain::Problem& problem, PartId part, const plan::Hold& hold,
            const OffInHand& off) {
  const domain::PartModel& model = *problem.part(part).model;
  const Vector2& pad = problem.workcell->gripper().pad_half_extents();
  const TouchingCells left = TouchingCellsOf(model, hold, 1, pad, off);
  const TouchingCells right = TouchingCellsOf(model, hold, -1, pad, off);
  if (left.middles.empty() || right.middles.empty()) return {};
  const bool alike = left.middles == right.middles;
  const double friction = PossiblePadFriction(problem).low;
  std::vector<PadCell> cells;
  Eigen::AlignedBox2d bounds;
  for (const TouchingCells* side : {&left, &right}) {
    if (side == &right && alike) continue;
    const double share = friction / static_cast<double>(side->middles.size());
    for (const Vector2& at : side->middles) {
      cells.push_back({at, alike ? 2 * share : share});
      bounds.extend(at - side->half);
      bounds.extend(at + side->half);
    }
  }
  PadFriction pads(std::move(cells));
  const Vector2 reach = (bounds.max() - pads.center()).cwiseMin(pads.center() - bounds.min());
  Grip grip = {std::move(pads), true, reach, alike};
  if (!LieOnFaces(model, hold, pad)) grip.couple = hold.width * friction;
  if (off.rolls) NoteRoundSide(model, hold, pad, off, friction, grip);
  return grip;
}

PlaneLoad ActingAt(const Vector2& lever, const Vector2& force) {
  return {.force = force, .torsion = lever.x() * force.y() - lever.y() * force.x()};
}

}  // namespace assay::uncertainty
