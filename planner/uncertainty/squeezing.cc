#include "planner/uncertainty/squeezing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/algebra/simplify.h"
#include "planner/domain/part_model.h"
#include "planner/uncertainty/axis_angle.h"

namespace assay::uncertainty {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;

HeldError AsPublished(const UncertainWorld& world, PartId part, const plan::Hold& hold) {
  Pose R_WorldTool = world.X_WorldPart(part) * hold.X_PartTool;
  R_WorldTool.translation().setZero();
  const SymbolicVector D = algebra::Simplify(algebra::Inverse(AsTransform(R_WorldTool)) *
                                             world.resting(part).displacement);
  return {.x = D[0], .z = D[2], .twist = 0};
}

Interval PlusMinus(double half_width) { return {-half_width, half_width}; }

// How far a contact at half_width across and half_pad along the pads slips when the part turns.
double SlipOf(double turn, double half_width, double half_pad) {
  const double angle = std::min(turn, kRightAngle);
  return half_width * std::sin(angle) + half_pad * (1 - std::cos(angle));
}

// How far the first pad may turn the part while it pushes it to the second.
double TurnOfPush(const UncertainWorld& world, PartId part, const plan::Hold& hold,
                  const Interval& along, double push) {
  const geometry::MassProperties& mass = world.problem().part(part).model->mass();
  const double lever = std::abs((hold.X_PartTool.inverse() * mass.center).x()) + Magnitude(along);
  if (lever <= world.problem().workcell->gripper().pad_half_extents().x()) return 0;
  const Vector3 up = world.X_WorldPart(part).linear().transpose() * Vector3::UnitZ();
  const double gyration = std::sqrt(up.dot(mass.inertia * up) / mass.mass);
  return push / (2 * gyration);
}

HeldError Sound(UncertainWorld& world, PartId part, const plan::Hold& hold,
                const ManipulatorError& draw) {
  const Pose X_WorldTool = world.X_WorldPart(part) * hold.X_PartTool;
  const Transform X_TrueHandPart = algebra::Inverse(AsTransform(X_WorldTool) * draw.AsTransform()) *
                                   PossiblePose(world.X_WorldPart(part), world.resting(part));
  const Transform grasp = AsTransform(hold.X_PartTool);
  const SymbolicVector grasped = algebra::Simplify(X_TrueHandPart * grasp.translation);

  const Vector3 up = VerticalInTool(X_WorldTool);
  const double theta = Magnitude(world.RangeOf(world.resting(part).theta));
  const double hand = Magnitude(world.RangeOf(draw.theta));
  // Tight: in plain interval arithmetic, what an earlier squeeze told is lost when the axes turn.
  const double push = Magnitude(world.TightRangeOf(grasped[1]));
  const double turn = TwistOf(theta, up.z()) + hand +
                      TurnOfPush(world, part, hold, world.TightRangeOf(grasped[0]), push);
  const double half_pad = world.problem().workcell->gripper().pad_half_extents().x();
  const auto declare = [&](const char* what, double half_width) {
    return world.Declare(fmt::format("{}_{}", what, world.SymbolName(part)), PlusMinus(half_width),
                         part);
  };
  const Expression slip_x = declare("slip", SlipOf(turn, hold.width / 2, half_pad));
  const Expression slip_z =
      declare("rise", SlipOf(TwistOf(theta, up.x()), hold.width / 2, half_pad));
  return {.x = grasped[0] + slip_x,
          .z = grasped[2] + slip_z,
          .twist = declare("twist", TwistOf(theta, up.y()))};
}

}  // namespace

HeldError ClosePads(UncertainWorld& world, PartId part, const plan::Hold& hold,
                    const ManipulatorError& draw) {
  if (world.propagation() == Propagation::kPaper) return AsPublished(world, part, hold);
  return Sound(world, part, hold, draw);
}

}  // namespace assay::uncertainty
