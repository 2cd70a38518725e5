#include "planner/uncertainty/error_sets/tip_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/algebra/expression/simplify.h"

namespace assay::uncertainty {
namespace {

constexpr double kAlmostOne = 1 - 1e-12;

// Returns half the antisymmetric part of a rotation: the rotation axis times the sine of the angle.
SymbolicVector SineVector(const Transform& turn) {
  const auto& R = turn.rotation;
  return {0.5 * (R[2][1] - R[1][2]), 0.5 * (R[0][2] - R[2][0]), 0.5 * (R[1][0] - R[0][1])};
}

Transform Rotation(const geometry::Matrix3& R) {
  Pose pose = Pose::Identity();
  pose.linear() = R;
  return AsTransform(pose);
}

}  // namespace

TipWay WayOf(const plan::Strategy& strategy) {
  return {strategy.X_HeldTip, strategy.X_FixedStart, strategy.motions.back().X_FixedTip.linear()};
}

std::vector<TipError> TipErrors(const UncertainWorld& world, domain::MatingId id,
                                const plan::Hold& hold, const Transform& X_ToolGrasp,
                                const TipWay& way) {
  const domain::Mating& mating = world.problem().mating(id);
  const Pose& X_WorldFixed = world.X_WorldPart(mating.fixed);
  const Transform to_fixed =
      algebra::Inverse(PossiblePose(X_WorldFixed, world.resting(mating.fixed)));
  const Pose X_TipTool = way.X_HeldTip.inverse() * hold.X_PartTool;
  std::vector<TipError> errors;
  for (const geometry::Matrix3& R :
       {geometry::Matrix3(way.X_FixedStart.linear()), way.R_FixedEnd}) {
    Pose X_FixedTip = way.X_FixedStart;
    X_FixedTip.linear() = R;
    const Transform held =
        PossibleHeldPose(X_WorldFixed * X_FixedTip * X_TipTool, X_ToolGrasp, hold.X_PartTool);
    const Transform tip = to_fixed * held * AsTransform(way.X_HeldTip);
    const SymbolicVector d = tip.translation - AsVector(X_FixedTip.translation());
    const SymbolicVector sine = SineVector(tip * Rotation(R.transpose()));
    const Transform back = Rotation(way.X_FixedStart.linear() * R.transpose());
    errors.push_back({algebra::Simplify(back * d), algebra::Simplify(back * sine)});
  }
  return errors;
}

TipBox BoxOf(const UncertainWorld& world, const std::vector<TipError>& errors) {
  TipBox box;
  Vector3 sines = Vector3::Zero();
  for (const TipError& error : errors) {
    for (const int axis : {0, 1, 2}) {
      box.d[axis] = std::max(box.d[axis], Magnitude(world.TightRangeOf(error.d[axis])));
      sines[axis] = std::max(sines[axis], Magnitude(world.TightRangeOf(error.sine[axis])));
    }
  }
  const double sine = sines.norm();
  if (sine >= kAlmostOne) {
    box.w.setConstant(std::numbers::pi);  // the part may be turned in any way
  } else if (sine > 0) {
    box.w = std::asin(sine) / sine * sines;
  }
  return box;
}

// The sine of an angle is smaller relative to the angle, the greater the angle is. So the angle of
// the whole vector decides.
Vector3 SinesWithin(const Vector3& w) {
  const double angle = w.norm();
  return angle > 0 ? Vector3(std::sin(angle) / angle * w) : w;
}

std::vector<Precondition> TipPreconditions(const UncertainWorld& world, domain::MatingId mating,
                                           const plan::Hold& hold, const Transform& X_ToolGrasp,
                                           const plan::Strategy& strategy) {
  Preconditions conditions;
  const Vector3& shift = strategy.certificate.d;
  const Vector3 sine = SinesWithin(strategy.certificate.w);
  for (const TipError& error : TipErrors(world, mating, hold, X_ToolGrasp, WayOf(strategy))) {
    for (const int axis : {0, 1, 2}) {
      conditions.Within(plan::condition::kTipShift,
                        "the tip is displaced by less than the strategy absorbs", error.d[axis],
                        shift[axis]);
      conditions.Within(plan::condition::kTipTurn,
                        "the tip is turned by less than the strategy absorbs", error.sine[axis],
                        sine[axis]);
    }
  }
  return conditions.Take();
}

}  // namespace assay::uncertainty
