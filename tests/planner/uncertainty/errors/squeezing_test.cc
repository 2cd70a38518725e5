#include "planner/uncertainty/errors/squeezing.h"

#include <gtest/gtest.h>

#include "tests/planner/uncertainty/part_on_table.h"

namespace assay::uncertainty::squeezing_test {
namespace {

HeldError CloseOn(UncertainWorld& world, const plan::Hold& hold) {
  return ClosePads(world, kBlock, hold, world.DrawManipulator());
}

// The error in the hand is D = (R_O R_G)^-1 d. It concerns the part's origin and does not depend on
// the part's rotation.
TEST(ClosePads, InPaperModeIsTheOriginsDisplacementInTheToolsAxes) {
  const domain::Problem problem = UprightBlock({});
  UncertainWorld world(problem, Propagation::kPaper);
  const HeldError held = CloseOn(world, HoldFromAbove(problem, Vector3::UnitX()));
  const SymbolicVector& d = world.resting(kBlock).displacement;
  EXPECT_EQ(held.x, d[1]);  // the tool's x is the world's y, and the tool's z points down
  EXPECT_EQ(held.z, -d[2]);
  EXPECT_TRUE(held.twist.IsConstant(0));
}

TEST(ClosePads, WithoutErrorsLeavesNone) {
  const domain::Problem problem = UprightBlock({.length = 0, .angle = 0, .hand = 0});
  UncertainWorld world(problem, Propagation::kSound);
  const HeldError held = CloseOn(world, HoldFromAbove(problem, Vector3::UnitX()));
  for (const Expression& e : {held.x, held.y, held.z, held.twist, held.skew, held.tip}) {
    EXPECT_NEAR(Magnitude(world.TightRangeOf(e)), 0, 1e-15);
  }
}

// A hand from above keeps the errors along the pads. These are the displacement, the lever arm of
// the rotation, and the slip while the faces turn flush. The slip is at least half the width times
// the sine of the rotation.
TEST(ClosePads, FromAboveCoversTheLeverArmAndTheSlip) {
  const Errors errors;
  const domain::Problem problem = UprightBlock(errors);
  const plan::Hold hold = HoldFromAbove(problem, Vector3::UnitX());
  UncertainWorld world(problem, Propagation::kSound);
  const HeldError held = CloseOn(world, hold);
  const double lever = std::abs(hold.X_PartTool.translation().x());
  const double least = errors.length + (lever + hold.width / 2) * std::sin(errors.angle);
  EXPECT_GE(Magnitude(world.TightRangeOf(held.x)), least);
  EXPECT_LE(Magnitude(world.TightRangeOf(held.x)), 1.5 * least);
  EXPECT_NEAR(Magnitude(world.TightRangeOf(held.z)), errors.length + errors.hand, 1e-9);
  for (const Expression& e : {held.y, held.twist, held.skew, held.tip}) {
    EXPECT_TRUE(e.IsConstant(0));
  }
}

// With the friction of rubber both contacts may hold the part at the angle at which they met it.
TEST(ClosePads, PadsThatMayJamLeaveTheRotation) {
  const Errors errors;
  domain::Problem problem = UprightBlock(errors);
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.pad_friction = 0.8;
  problem.workcell = problem.workcell->WithRules(rules);
  UncertainWorld world(problem, Propagation::kSound);
  const HeldError held = CloseOn(world, HoldFromAbove(problem, Vector3::UnitX()));
  EXPECT_GE(Magnitude(world.TightRangeOf(held.skew)), errors.angle);
}

}  // namespace
}  // namespace assay::uncertainty::squeezing_test
