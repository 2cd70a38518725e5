#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/domain/parts/part_model.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/plan/certificates/carrying.h"
#include "planner/uncertainty/error_sets/axis_angle.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/pads/grip.h"
#include "planner/uncertainty/preconditions/precondition.h"

namespace assay::uncertainty {
namespace {

constexpr int kDirections = 8;  // number of directions in a half circle of accelerations
constexpr int kLeans = 12;      // number of leans from the plane of the pads to straight across it

// Returns an upper bound of the load ratio over unit forces in all directions. The ratio is a norm,
// so its values at the corners of a polygon around the unit circle bound it.
double RatioOfAnyForce(const PadFriction& friction, const Vector2& lever) {
  double greatest = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = std::numbers::pi * i / kDirections;
    const PlaneLoad load = ActingAt(lever, {std::cos(angle), std::sin(angle)});
    greatest = std::max(greatest, friction.RatioOf(load));
  }
  return greatest / std::cos(std::numbers::pi / (2 * kDirections));
}

// The mass that is to be held.
struct Carried {
  geometry::MassProperties mass;
  Vector3 center;  // centre of mass, in the tool's frame
  double off = 0;  // metres by which the centre of mass may be elsewhere
};

// The greatest weight, in the plane of the pads and across it.
struct Weighing {
  double in_plane = 0;  // ratio of the load to what one newton on each pad bears
  double across = 0;    // newtons
};

Weighing WeighingOf(const Grip& grip, const Vector2& lever, double weight, const Vector3& up) {
  const Vector2 in_plane = weight * Vector2(up.x(), up.z());
  return {grip.friction.RatioOf(ActingAt(lever, in_plane)), weight * std::abs(up.y())};
}

// Returns the weighings for all leans of the tool. Each weighing covers one interval of leans,
// between the plane of the pads and straight across it. It takes the greatest share of the weight
// in the plane within this interval, and the greatest share across the plane.
std::vector<Weighing> AnyWeighing(double any_force, double weight) {
  std::vector<Weighing> weighings;
  for (int i = 0; i < kLeans; ++i) {
    const double step = std::numbers::pi / 2 / kLeans;
    weighings.push_back(
        {weight * any_force * std::cos(i * step), weight * std::sin((i + 1) * step)});
  }
  return weighings;
}

// Returns the ratio of the load to what the grip bears with `force` newtons on each pad. `up` is
// the vertical in the tool's frame, with an error of up to `sway` radians. It is null if the hand
// may turn freely.
double LoadRatio(const Grip& grip, double force, const Carried& carried, const Vector3* up,
                 double sway) {
  const Vector2 lever = Vector2(carried.center.x(), carried.center.z()) - grip.friction.center();
  const double any_force = RatioOfAnyForce(grip.friction, lever);
  const double weight = carried.mass.mass * kGravity;
  const double inertial = carried.mass.mass * plan::kCarryingAcceleration + weight * sway;
  const double turning = carried.mass.inertia.norm() * plan::kCarryingTurn;
  const double off = (weight + inertial) * carried.off + turning;  // newton metres
  const auto ratio_of = [&](const Weighing& weighing) {
    const double across = weighing.across + inertial;
    return grip.RatioOf({.slipping = weighing.in_plane + inertial * any_force +
                                     grip.friction.RatioOf({.torsion = off}),
                         .across = across,
                         .tilting = across * lever.norm() +
                                    (weight + inertial) * std::abs(carried.center.y()) + off},
                        force);
  };
  if (up != nullptr) return ratio_of(WeighingOf(grip, lever, weight, *up));
  double greatest = 0;
  for (const Weighing& weighing : AnyWeighing(any_force, weight)) {
    greatest = std::max(greatest, ratio_of(weighing));
  }
  return greatest;
}

// Returns whether pads may have jammed before the part's faces lay flat on them. They may then
// touch the part at two corners. Friction does not keep the part from rolling from one of these
// corners to the other, so nothing keeps it from turning in the hand. A round part touches the pads
// in the same way at every turn about its axis, so its skew does not show that the pads have
// jammed.
bool MayHaveJammed(const UncertainWorld& world, const HeldError& held) {
  return (Magnitude(world.RangeOf(held.skew)) > 0 && !held.is_round) ||
         Magnitude(world.RangeOf(held.tip)) > 0;
}

}  // namespace

std::vector<Precondition> HoldingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const HeldError& held,
                                               Turning turning) {
  const domain::Problem& problem = world.problem();
  const domain::WorkcellRules& rules = problem.workcell->rules();
  const OffInHand off = OffInHandOf(world, held);
  const Grip grip = GripOf(problem, part, hold, off);
  const Vector3 up = VerticalInTool(world.X_WorldPart(part) * hold.X_PartTool);
  double ratio = MayHaveJammed(world, held) ? kNothingBorne : 0;
  for (const geometry::MassProperties& mass : PossibleMasses(problem, part)) {
    const Vector3 center = hold.X_PartTool.inverse() * mass.center;
    const Carried carried = {mass, center, off.shift.norm() + off.turn * center.norm()};
    ratio = std::max(
        ratio, LoadRatio(grip, rules.grip_force, carried, turning == Turning::kNone ? &up : nullptr,
                         Magnitude(problem.gripper_error.theta)));
  }
  Preconditions conditions;
  conditions.Less(plan::condition::kHolding, "the pads' friction bears the part", ratio, 1);
  return conditions.Take();
}

}  // namespace assay::uncertainty
