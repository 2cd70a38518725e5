#include "planner/uncertainty/error_sets/release.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/domain/matings/shaft_fit.h"
#include "planner/geometry/pose.h"
#include "planner/uncertainty/standing/tilting.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/uncertainty/part_on_table.h"

namespace assay::uncertainty::release_test {
namespace {

struct Released {
  ManipulatorError draw;
  RestingError error;
};

// Releases a part that was held exactly as planned, with a hand that errs.
Released LetGo(UncertainWorld& world, const plan::Hold& hold) {
  world.SetHeld(kBlock, {.x = 0, .z = 0});
  const ManipulatorError draw = world.DrawManipulator();
  const Transform grasp = PossibleGrasp(world.held(), draw, world.propagation());
  return {draw, Release(world, kBlock, hold, grasp, draw, world.X_WorldPart(kBlock))};
}

// For a tool that points down, the part's yaw is the hand's error about its axis with the opposite
// sign (-tg).
TEST(Release, FromAboveTheYawIsTheHandsReversed) {
  const domain::Problem problem = UprightBlock({});
  for (const auto mode : {Propagation::kPaper, Propagation::kSound}) {
    UncertainWorld world(problem, mode);
    const auto [draw, error] = LetGo(world, HoldFromAbove(problem, Vector3::UnitX()));
    EXPECT_EQ(error.theta, -draw.theta);
  }
}

// The displacement is R_T R_G [t' - (R' - I) R_G^t t_G].
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

// A tool that leans by the angle a turns the part about its own approach axis. If the pads give way
// only across that axis, the upright part keeps a yaw with tan(yaw / 2) = tan(turn / 2) / cos(a).
// If they let go before the table levels the part, it falls, and may turn farther.
TEST(Release, LeaningTheTableMayAddToTheHandsTurn) {
  const Errors errors{.hand = 1e-3};
  const domain::Problem problem = UprightBlock(errors);
  plan::Hold hold = HoldFromAbove(problem, Vector3::UnitX());
  const double lean = 0.5;
  hold.X_PartTool = hold.X_PartTool * geometry::RotationY(lean);
  UncertainWorld world(problem, Propagation::kSound);
  const RestingError error = LetGo(world, hold).error;
  const double twist = 2 * std::atan(std::tan(10 * errors.hand / 2) / std::cos(lean));
  const double fallen =
      10 * errors.hand *
      (std::cos(lean) + std::sin(lean) * FallOf(world, kBlock, world.X_WorldPart(kBlock)).turn);
  EXPECT_GE(Magnitude(world.TightRangeOf(error.theta)), std::max(twist, fallen) - 1e-7);
  EXPECT_LE(Magnitude(world.TightRangeOf(error.theta)), 1.01 * std::max(twist, fallen));
}

// Pads that close on a tilted direction are two inclined planes. If they slide down by s on a part
// that stands, they push it aside by s tan(tilt), as the wedge of a known angle does.
TEST(ReleaseOnTable, PadsThatSlideDownPushThePartAsideLikeAWedge) {
  for (const double tilt : {0.0, 0.1, 0.3}) {
    for (const double grip_force : {20.0, 1000.0}) {
      domain::Problem problem = UprightBlock({});
      domain::WorkcellRules rules = problem.workcell->rules();
      rules.grip_force = grip_force;  // with a friction of 0.05: 2 N or 100 N
      problem.workcell = problem.workcell->WithRules(rules);
      plan::Hold hold = HoldFromAbove(problem, Vector3::UnitX());
      hold.X_PartTool = geometry::RotationY(tilt) * hold.X_PartTool;
      UncertainWorld world(problem, Propagation::kSound);
      const auto [draw, error] = LetGo(world, hold);
      const Transform grasp = PossibleGrasp(world.held(), draw, world.propagation());
      const RestingError on_table =
          ReleaseOnTable(world, kBlock, hold, grasp, draw, world.X_WorldPart(kBlock));
      const double slide = grip_force > 20 ? 0 : SlideOfPads(world, draw, error);
      EXPECT_EQ(slide > 0, grip_force == 20);
      const auto most = [&](const Expression& along) {
        return Magnitude(world.TightRangeOf(along));
      };
      EXPECT_NEAR(most(on_table.displacement[0]) - most(error.displacement[0]),
                  slide * std::tan(tilt), 1e-4 * slide + 1e-12);
      EXPECT_NEAR(most(on_table.displacement[1]), most(error.displacement[1]), 1e-12);
    }
  }
}

// Returns the yaw that is left after the table levels the part with the least work. The resistance
// of the pads to each axis is `weights` times the angle for friction. For springs
// (LeftAfterSprings) the resistance is half of `weights` times the square of the angle.
double LeftAfterFriction(const Vector3& turned, const Vector3& up, const Vector3& weights) {
  const auto work = [&](double twist) { return weights.dot((turned - twist * up).cwiseAbs()); };
  const Vector3 ends = turned.cwiseQuotient(up);
  return *std::min_element(ends.begin(), ends.end(),
                           [&](double a, double b) { return work(a) < work(b); });
}

double LeftAfterSprings(const Vector3& turned, const Vector3& up, const Vector3& weights) {
  return weights.dot(turned.cwiseProduct(up)) / weights.dot(up.cwiseAbs2());
}

TEST(LeaningOf, BoundsWhatPadsOfAnyStiffnessLeave) {
  RandomStream random(3, "pads");
  const domain::Problem problem = UprightBlock({.hand = 1e-3});
  for (int i = 0; i < 500; ++i) {
    const Vector3 up = oracle::RandomRotation(random).col(0);
    const Vector3 most(random.Uniform(0, 0.03), random.Uniform(0, 0.03), 10e-3);
    UncertainWorld world(problem, Propagation::kSound);
    HeldError held = {.x = 0, .z = 0};
    held.tip = world.Declare(plan::error::kTip, {-most.x(), most.x()}, kBlock);
    held.twist = world.Declare(plan::error::kTwist, {-most.y(), most.y()}, kBlock);
    world.SetHeld(kBlock, held);
    const Leaning leaning = LeaningOf(world, up, world.DrawManipulator());
    const Vector3 signs(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
    const Vector3 turned = most.cwiseProduct(signs.cwiseSign());
    const Vector3 weights(std::exp(random.Uniform(-3, 3)), std::exp(random.Uniform(-3, 3)),
                          std::exp(random.Uniform(-3, 3)));
    for (const double twist :
         {LeftAfterFriction(turned, up, weights), LeftAfterSprings(turned, up, weights)}) {
      EXPECT_LE(std::abs(twist), leaning.twist + 1e-12);
      EXPECT_LE((turned - twist * up).norm(), leaning.levelling + 1e-12);
    }
    EXPECT_LE((turned - turned.dot(up) * up).norm(), leaning.tilt + 1e-6);
  }
}

// Returns the greatest displacement of a part across its seat, which leans by `lean`. A hand
// without errors lets the part go in the seat. The friction between the two parts is surely at
// least `friction`.
double DisplacedInSeat(double lean, double friction) {
  domain::Problem problem = LoadScenario("spar-example");
  const domain::Mating& mating = problem.matings.front();
  domain::Part& fixed = problem.parts[mating.fixed.index()];
  problem.gripper_error = Symmetric(0, 0);
  fixed.error = Symmetric(0, 0);
  problem.tolerances.friction =
      std::max(fixed.model->friction(), problem.part(mating.held).model->friction()) - friction;
  const Vector3 leaning(std::sin(lean), 0, -std::cos(lean));
  fixed.X_WorldPart.linear() =
      Eigen::Quaterniond::FromTwoVectors(mating.mating_vector, leaning).toRotationMatrix();
  UncertainWorld world(problem, Propagation::kSound);
  world.SetHeld(mating.held, {.x = 0, .z = 0});
  const ManipulatorError draw = world.DrawManipulator();
  const plan::Hold hold = HoldFromAbove(problem, Vector3::UnitX());
  const Transform grasp = PossibleGrasp(world.held(), draw, world.propagation());
  const RestingError error = ReleaseInSeat(world, domain::MatingId(0), hold, grasp, draw);
  return Magnitude(world.TightRangeOf(error.displacement[1]));
}

// Below the angle of friction the part stays where the hand let it go; above, the walls alone hold
// it, and it may slide by all its play.
TEST(ReleaseInSeat, APartOnASmoothSeatThatLeansMaySlideByItsPlay) {
  const domain::Problem problem = LoadScenario("spar-example");
  const double play = domain::PlayInSeat(problem, problem.matings.front(), 0).shift;
  ASSERT_GT(play, 0);
  const double lean = 0.1;
  EXPECT_GE(DisplacedInSeat(lean, 0.9 * std::tan(lean)), play - 1e-12);
  EXPECT_NEAR(DisplacedInSeat(lean, 1.1 * std::tan(lean)), 0, 1e-9);
  EXPECT_NEAR(DisplacedInSeat(0, 0.001), 0, 1e-9);
}

}  // namespace
}  // namespace assay::uncertainty::release_test
