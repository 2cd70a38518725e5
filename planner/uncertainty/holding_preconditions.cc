#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/domain/part_model.h"
#include "planner/plan/carrying.h"
#include "planner/uncertainty/axis_angle.h"
#include "planner/uncertainty/pad_friction.h"
#include "planner/uncertainty/possible_masses.h"
#include "planner/uncertainty/precondition.h"

namespace assay::uncertainty {
namespace {

using geometry::Polygon;

constexpr double kGravity = 9.81;   // m/s^2
constexpr int kCellsPerSide = 6;    // of a pad
constexpr int kDirections = 8;      // of a half circle of accelerations
constexpr double kOnFace = 1e-5;    // metres
constexpr double kNotHeld = 1e6;    // the ratio where nothing is borne
constexpr double kSameFace = 1e-6;  // 1 - cosine

// The face that a pad lies on: `side` along the tool's y.
const domain::Face* FaceAt(const domain::PartModel& model, const plan::Hold& hold, double side) {
  const Vector3 normal = side * hold.X_PartTool.linear().col(1);
  const double offset = normal.dot(hold.X_PartTool.translation()) + hold.width / 2;
  const auto is_it = [&](const domain::Face& face) {
    return face.normal.dot(normal) > 1 - kSameFace && std::abs(face.offset - offset) < kOnFace;
  };
  const auto found = std::ranges::find_if(model.faces(), is_it);
  return found == model.faces().end() ? nullptr : &*found;
}

// The corners of a rectangle about `middle` (x and z of the tool), in the face's coordinates.
Polygon OnFaceOf(const domain::Face& face, const plan::Hold& hold, double side,
                 const Vector2& middle, const Vector2& half) {
  const Pose X_FaceTool = face.X_PartFace.inverse() * hold.X_PartTool;
  std::vector<Vector2> corners;
  for (const double x : {-half.x(), half.x()}) {
    for (const double z : {-half.y(), half.y()}) {
      const Vector3 corner(middle.x() + x, side * hold.width / 2, middle.y() + z);
      corners.push_back((X_FaceTool * corner).head<2>());
    }
  }
  return geometry::Hull2(corners);
}

// By how much what is held may be off in the hand: metres along the tool's axes, and radians.
struct OffInHand {
  Vector3 shift;
  double turn = 0;
};

OffInHand OffInHandOf(const UncertainWorld& world, const HeldError& held) {
  const auto most = [&](const Expression& e) { return Magnitude(world.RangeOf(e)); };
  return {.shift = {most(held.x), most(held.y), most(held.z)},
          .turn = most(held.skew) + most(held.tip) + most(held.twist)};
}

// Where a pad surely touches its face, whatever the part is off in the hand: middles of cells, in
// the tool's x and z.
std::vector<Vector2> TouchingCells(const domain::PartModel& model, const plan::Hold& hold,
                                   double side, const Vector2& pad, const OffInHand& off) {
  const domain::Face* face = FaceAt(model, hold, side);
  if (face == nullptr) return {};
  const Vector2 cell = pad / kCellsPerSide;
  const Vector2 may_shift = Vector2(off.shift.x(), off.shift.z()).array() + off.turn * pad.norm();
  const auto covers = [&](const Vector2& middle, const Vector2& half) {
    return face->Covers(OnFaceOf(*face, hold, side, middle, half + may_shift));
  };
  const bool covers_all = covers(Vector2::Zero(), pad);
  std::vector<Vector2> cells;
  for (int i = 0; i < kCellsPerSide; ++i) {
    for (int j = 0; j < kCellsPerSide; ++j) {
      const Vector2 middle = cell.cwiseProduct(2 * Vector2(i, j) + Vector2::Ones()) - pad;
      if (covers_all || covers(middle, cell)) cells.push_back(middle);
    }
  }
  return cells;
}

// How two pads that press on a part with one newton each hold it.
struct Grip {
  PadFriction friction;
  Vector2 reach;  // of the pressure from the center of friction, in any sense; metres
};

Grip GripOf(const std::vector<Vector2>& left, const std::vector<Vector2>& right, double friction,
            const Vector2& cell) {
  if (left.empty() || right.empty()) return {PadFriction({}), Vector2::Zero()};
  std::vector<PadCell> cells;
  Vector2 low = left.front();
  Vector2 high = left.front();
  for (const std::vector<Vector2>* pad : {&left, &right}) {
    if (pad == &right && left == right) continue;
    const double share = friction / static_cast<double>(pad->size());
    for (const Vector2& at : *pad) {
      cells.push_back({at, left == right ? 2 * share : share});
      low = low.cwiseMin(at - cell);
      high = high.cwiseMax(at + cell);
    }
  }
  PadFriction pads(std::move(cells));
  const Vector2 reach = (high - pads.center()).cwiseMin(pads.center() - low);
  return {std::move(pads), reach};
}

// Unit forces in the plane of the pads, and the torsion that each has by acting at `lever` from
// the center of friction.
PlaneLoad ActingAt(const Vector2& lever, const Vector2& force) {
  return {.force = force, .torsion = lever.x() * force.y() - lever.y() * force.x()};
}

// The greatest ratio of a unit force in any direction: of the corners of a polygon around the
// circle, since the ratio is a norm.
double RatioOfAnyForce(const PadFriction& friction, const Vector2& lever) {
  double greatest = 0;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = std::numbers::pi * i / kDirections;
    const PlaneLoad load = ActingAt(lever, {std::cos(angle), std::sin(angle)});
    greatest = std::max(greatest, friction.RatioOf(load));
  }
  return greatest / std::cos(std::numbers::pi / (2 * kDirections));
}

// What is to be held.
struct Carried {
  geometry::MassProperties mass;
  Vector3 center;  // of mass, in the tool
  double off = 0;  // by which it may be elsewhere, metres
};

// The greatest of the weight, in the plane of the pads and across it.
struct Weighing {
  double in_plane = 0;  // over what one newton on each pad bears
  double across = 0;    // newtons
};

Weighing WeighingOf(const Grip& grip, const Vector2& lever, double weight, const Vector3& up) {
  const Vector2 in_plane = weight * Vector2(up.x(), up.z());
  return {grip.friction.RatioOf(ActingAt(lever, in_plane)), weight * std::abs(up.y())};
}

// The load over what the grip bears with `force` newtons on each pad. `up`: the vertical, as the
// tool sees it, to within `sway` radians; null where the hand may turn as it likes.
//
// Forces along the closing direction are borne by the pads' pressures, one of which they lower;
// moments about the other axes by pressure that moves to an edge of each pad, whose friction then
// counts for nothing.
double LoadRatio(const Grip& grip, double force, const Carried& carried, const Vector3* up,
                 double sway) {
  const Vector2 lever = Vector2(carried.center.x(), carried.center.z()) - grip.friction.center();
  const double any_force = RatioOfAnyForce(grip.friction, lever);
  const double weight = carried.mass.mass * kGravity;
  const double inertial = carried.mass.mass * plan::kCarryingAcceleration + weight * sway;
  const double turning = carried.mass.inertia.norm() * plan::kCarryingTurn;
  const double off = (weight + inertial) * carried.off + turning;  // newton metres
  const Weighing weighing =
      up != nullptr ? WeighingOf(grip, lever, weight, *up) : Weighing{weight * any_force, weight};
  const double across = weighing.across + inertial;
  const double pressing = force - across / 2;
  if (!(pressing > 0)) return kNotHeld;
  const double slipping =
      weighing.in_plane + inertial * any_force + grip.friction.RatioOf({.torsion = off});
  const double moment =
      across * lever.norm() + (weight + inertial) * std::abs(carried.center.y()) + off;
  const double tilting = moment / (2 * grip.reach.minCoeff());
  return std::min(kNotHeld, (slipping + tilting) / pressing);
}

}  // namespace

std::vector<Precondition> HoldingPreconditions(const UncertainWorld& world, PartId part,
                                               const plan::Hold& hold, const HeldError& held,
                                               Turning turning) {
  const domain::Problem& problem = world.problem();
  const domain::WorkcellRules& rules = problem.workcell->rules();
  const domain::PartModel& model = *problem.part(part).model;
  const Vector2& pad = problem.workcell->gripper().pad_half_extents();
  const OffInHand off = OffInHandOf(world, held);
  const Grip grip =
      GripOf(TouchingCells(model, hold, 1, pad, off), TouchingCells(model, hold, -1, pad, off),
             rules.pad_friction - problem.tolerances.pad_friction, pad / kCellsPerSide);
  const Vector3 up = VerticalInTool(world.X_WorldPart(part) * hold.X_PartTool);
  double ratio = 0;
  for (const geometry::MassProperties& mass : PossibleMasses(problem, part)) {
    const Vector3 center = hold.X_PartTool.inverse() * mass.center;
    const Carried carried = {mass, center, off.shift.norm() + off.turn * center.norm()};
    ratio = std::max(
        ratio, LoadRatio(grip, rules.grip_force, carried, turning == Turning::kNone ? &up : nullptr,
                         Magnitude(problem.gripper_error.theta)));
  }
  Preconditions conditions;
  conditions.Less("holding", "the pads' friction bears the part", ratio, 1);
  return conditions.Take();
}

}  // namespace assay::uncertainty
