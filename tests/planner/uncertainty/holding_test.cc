#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/plan/certificates/carrying.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "tests/planner/uncertainty/part_on_table.h"

namespace assay::uncertainty::holding_test {
namespace {

constexpr double kGravity = 9.81;  // m/s^2
const HeldError kExact = {.x = 0, .z = 0};

// Returns the block without errors in a workcell with this force and friction.
domain::Problem Block(double grip_force, double pad_friction, double tolerance = 0) {
  domain::Problem problem = UprightBlock({.length = 0, .angle = 0, .hand = 0});
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.grip_force = grip_force;
  rules.pad_friction = pad_friction;
  problem.workcell = problem.workcell->WithRules(rules);
  problem.tolerances.pad_friction = tolerance;
  return problem;
}

// Returns a hold from above. The middle of the pads is `from_center` from the centre of mass, in
// the part's axes.
plan::Hold HoldAt(const domain::Problem& problem, const Vector3& from_center) {
  plan::Hold hold = HoldFromAbove(problem, Vector3::UnitY());
  hold.X_PartTool.translation() = problem.part(kBlock).model->mass().center + from_center;
  hold.X_PartTool.translation().y() = 0;  // midway between the faces
  return hold;
}

double RatioOf(const domain::Problem& problem, const plan::Hold& hold,
               const HeldError& held = kExact, Turning turning = Turning::kNone) {
  const UncertainWorld world(problem, Propagation::kSound);
  const auto conditions = HoldingPreconditions(world, kBlock, hold, held, turning);
  EXPECT_EQ(conditions.size(), 1);
  EXPECT_EQ(conditions.front().condition, plan::condition::kHolding);
  EXPECT_EQ(conditions.front().limit, 1);
  return world.RangeOf(conditions.front().expression).high;
}

double MassOfBlock(const domain::Problem& problem) {
  return problem.part(kBlock).model->mass().mass;
}

// A part that is held at its centre of mass loads the pads with its weight and acceleration. The
// ratio is this load over twice friction times force. Turning adds little to it.
TEST(Holding, AtTheCentreOfMassTheWeightCountsAlone) {
  const domain::Problem problem = Block(100, 0.15);
  const double load = MassOfBlock(problem) * (kGravity + plan::kCarryingAcceleration);
  const double ratio = RatioOf(problem, HoldAt(problem, Vector3::Zero()));
  EXPECT_GE(ratio, load / (2 * 0.15 * 100));
  EXPECT_LE(ratio, 1.5 * load / (2 * 0.15 * 100));
}

// The ratio is at least the torsion of the weight over the exact torsion that an even pressure
// bears.
TEST(Holding, ALeverAsideIsBorneByTorsion) {
  const domain::Problem problem = Block(100, 0.15);
  const double a = problem.workcell->gripper().pad_half_extents().x();
  const double torsion = 2 * 0.15 * 100 * (std::sqrt(2.0) + std::asinh(1.0)) / 3 * a;
  const double lever = 0.025;
  const double ratio = RatioOf(problem, HoldAt(problem, {lever, 0, 0}));
  EXPECT_GE(ratio, MassOfBlock(problem) * kGravity * lever / torsion);
  EXPECT_GT(ratio, 1.5 * RatioOf(problem, HoldAt(problem, Vector3::Zero())));
}

TEST(Holding, GoesDownWithForceAndFriction) {
  const auto ratio = [](double force, double friction, double tolerance) {
    const domain::Problem problem = Block(force, friction, tolerance);
    return RatioOf(problem, HoldAt(problem, {0.02, 0, 0.03}));
  };
  EXPECT_LT(ratio(100, 0.15, 0), ratio(50, 0.15, 0));
  EXPECT_LT(ratio(100, 0.15, 0), ratio(100, 0.1, 0));
  // The least friction within the tolerance counts.
  EXPECT_EQ(ratio(100, 0.15, 0.05), ratio(100, 0.15 - 0.05, 0));
  // This grip is weaker than the push of the weight.
  EXPECT_GT(ratio(0.001, 0.15, 0), 1000);
}

// Errors make levers longer and patches smaller, so that the load never becomes smaller.
TEST(Holding, ErrorsInTheHandOnlyAdd) {
  const domain::Problem problem = Block(100, 0.15);
  for (const double lever : {0.0, 0.01, 0.02}) {
    const plan::Hold hold = HoldAt(problem, {lever, 0, 0.03});
    const double exact = RatioOf(problem, hold);
    EXPECT_GT(RatioOf(problem, hold, {.x = 0.003, .z = 0}), exact);
    EXPECT_GT(RatioOf(problem, hold, {.x = 0, .z = 0, .twist = 0.1}), exact);
  }
}

// Two corners that touch a part cannot keep it from turning about the line through both of them.
TEST(Holding, JammedPadsHoldNothing) {
  const domain::Problem problem = Block(100, 0.15);
  const plan::Hold hold = HoldAt(problem, Vector3::Zero());
  EXPECT_GT(RatioOf(problem, hold, {.x = 0, .z = 0, .skew = 0.001}), 1000);
  EXPECT_GT(RatioOf(problem, hold, {.x = 0, .z = 0, .tip = 0.001}), 1000);
}

// If the pads stand out over the edge of the part, the area that surely touches is smaller.
TEST(Holding, BesideTheFaceNothingIsHeld) {
  const domain::Problem problem = Block(100, 0.15);
  const double half = 1.5 * kInch;
  EXPECT_GT(RatioOf(problem, HoldAt(problem, {half + 0.02, 0, 0})), 1000);
}

// The ratio for a hand that may lean in any way is at least the ratio in each single pose.
TEST(Holding, HoweverTheHandLeansTheRatioIsNoGreater) {
  const domain::Problem level = Block(100, 0.15);
  const plan::Hold hold = HoldAt(level, {0.01, 0, 0.05});
  const double any = RatioOf(level, hold, kExact, Turning::kAny);
  double greatest = 0;
  for (int i = 0; i < 36; ++i) {
    for (const bool about_x : {false, true}) {
      domain::Problem leaning = level;
      const double angle = M_PI * i / 18;
      const Pose turn = about_x ? geometry::RotationX(angle) : geometry::RotationY(angle);
      leaning.parts[kBlock.index()].X_WorldPart = turn;
      greatest = std::max(greatest, RatioOf(leaning, hold));
    }
  }
  EXPECT_GT(greatest, 1.5 * RatioOf(level, hold));
  EXPECT_GE(any, greatest);
  EXPECT_LE(any, 2 * greatest);
}

}  // namespace
}  // namespace assay::uncertainty::holding_test
