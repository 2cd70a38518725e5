#include "planner/uncertainty/release.h"

#include <gtest/gtest.h>

#include "tests/planner/uncertainty/part_on_table.h"

namespace assay::uncertainty::release_test {
namespace {

struct Released {
  ManipulatorError draw;
  RestingError error;
};

// A part that was held exactly as planned, let go with a hand that errs.
Released LetGo(UncertainWorld& world, const plan::Hold& hold) {
  world.SetHeld(kBlock, {.x = 0, .z = 0});
  const ManipulatorError draw = world.DrawManipulator();
  const Transform grasp = PossibleGrasp(world.held(), draw, world.propagation());
  return {draw, Release(world, kBlock, hold, grasp, draw, world.X_WorldPart(kBlock))};
}

// The yaw is the hand's: -tg for a tool that points down.
TEST(Release, FromAboveTheYawIsTheHandsReversed) {
  const domain::Problem problem = UprightBlock({});
  for (const auto mode : {Propagation::kPaper, Propagation::kSound}) {
    UncertainWorld world(problem, mode);
    const auto [draw, error] = LetGo(world, HoldFromAbove(problem, Vector3::UnitX()));
    EXPECT_EQ(error.theta, -draw.theta);
  }
}

// Displacement R_T R_G [t' - (R' - I) R_G^t t_G].
TEST(Release, DisplacesByTheHandAndByTheLeverArmOfItsTurn) {
  const Errors errors;
  const domain::Problem problem = UprightBlock(errors);
  const plan::Hold hold = HoldFromAbove(problem, Vector3::UnitX());
  UncertainWorld world(problem, Propagation::kSound);
  const RestingError error = LetGo(world, hold).error;
  const Vector3 lever = hold.X_PartTool.translation();
  const double turn = std::sin(10 * errors.hand);
  EXPECT_NEAR(Magnitude(world.TightRangeOf(error.displacement[0])),
              errors.hand + std::abs(lever.y()) * turn, 1e-6);
  EXPECT_NEAR(Magnitude(world.TightRangeOf(error.displacement[1])),
              errors.hand + std::abs(lever.x()) * turn, 1e-6);
}

// A tool that leans by a turns the part about its own axis; upright again, it keeps the twist,
// tan(yaw / 2) = cos(a) tan(turn / 2), and more may have been added by the settling alone.
TEST(Release, LeaningTheYawIsTheTwistOfTheHands) {
  const Errors errors{.hand = 1e-3};
  const domain::Problem problem = UprightBlock(errors);
  plan::Hold hold = HoldFromAbove(problem, Vector3::UnitX());
  const double lean = 0.5;
  hold.X_PartTool = hold.X_PartTool * geometry::RotationY(lean);
  UncertainWorld world(problem, Propagation::kSound);
  const RestingError error = LetGo(world, hold).error;
  const double twist = 2 * std::atan(std::cos(lean) * std::tan(10 * errors.hand / 2));
  EXPECT_GE(Magnitude(world.TightRangeOf(error.theta)), twist - 1e-15);
  EXPECT_LE(Magnitude(world.TightRangeOf(error.theta)), 1.01 * twist);
}

}  // namespace
}  // namespace assay::uncertainty::release_test
