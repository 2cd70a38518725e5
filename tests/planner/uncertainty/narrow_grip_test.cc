#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/random.h"
#include "planner/domain/parts/part_file.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/plan/certificates/carrying.h"
#include "planner/uncertainty/error_sets/squeezing.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "tests/planner/uncertainty/part_on_table.h"

// Pads of 16 mm on faces that are narrower than they are.
namespace assay::uncertainty::narrow_grip_test {
namespace {

using geometry::Vector2;

constexpr std::uint64_t kSeed = 30;
constexpr double kWidth = 0.04;    // of the parts between the pads, metres
constexpr double kPad = 0.008;     // half the extents of a pad, metres
constexpr double kGravity = 9.81;  // m/s^2

// Returns a problem with a part of 100 mm height, which stands upright with its axes along the
// world's. `body` is a solid of a part file, in millimetres.
domain::Problem Standing(const std::string& body, const Errors& errors, double pad_friction) {
  domain::Problem problem = UprightBlock(errors);
  domain::Part& part = problem.parts[kBlock.index()];
  part.model = domain::PartFile::Read(
      Document::Parse(fmt::format("format: assay-part/1\nname: bar\ninitial: B\n"
                                  "units: {{length: mm, angle: degree}}\ndensity: 1000\n"
                                  "friction: 0.25\nsolids:\n  body: {}\n",
                                  body),
                      "part.yaml"),
      0);
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.pad_friction = pad_friction;
  problem.workcell = problem.workcell->WithRules(rules);
  return problem;
}

// Returns a bar whose held faces are `breadth` millimetres wide.
domain::Problem Bar(double breadth, const Errors& errors = {.length = 0, .angle = 0, .hand = 0},
                    double pad_friction = 0.15) {
  return Standing(fmt::format("{{box: [[{}, -20, 0], [{}, 20, 100]]}}", -breadth / 2, breadth / 2),
                  errors, pad_friction);
}

domain::Problem Cylinder(int sides, const Errors& errors, double pad_friction = 0.15) {
  return Standing(fmt::format("{{cylinder: {{from: [0, 0, 0], to: [0, 0, 100], radius: 20, "
                              "sides: {}}}}}",
                              sides),
                  errors, pad_friction);
}

// Returns a hold from above, whose pads close along y at the part's axis.
plan::Hold FromAbove(double height = 0.05) {
  return {"from above",
          geometry::PoseFromColumns(Vector3::UnitX(), -Vector3::UnitY(), -Vector3::UnitZ(),
                                    {0, 0, height}),
          kWidth};
}

double HoldingRatio(const domain::Problem& problem, const HeldError& held = {.x = 0, .z = 0}) {
  const UncertainWorld world(problem, Propagation::kSound);
  const auto conditions = HoldingPreconditions(world, kBlock, FromAbove(), held, Turning::kNone);
  return world.RangeOf(conditions.front().expression).high;
}

struct Closed {
  bool is_round = false;
  double x = 0, y = 0, skew = 0;  // the greatest errors
  double holding = 0;             // the ratio of holding the part afterwards
};
Closed Close(const domain::Problem& problem) {
  UncertainWorld world(problem, Propagation::kSound);
  const HeldError held = ClosePads(world, kBlock, FromAbove(), world.DrawManipulator());
  const auto most = [&](const Expression& e) { return Magnitude(world.TightRangeOf(e)); };
  const auto holding = HoldingPreconditions(world, kBlock, FromAbove(), held, Turning::kNone);
  return {held.is_round, most(held.x), most(held.y), most(held.skew),
          world.RangeOf(holding.front().expression).high};
}

// A face that is a little narrower than the pads bears nearly what a face bears that has room for
// them.
TEST(NarrowGrip, BearsLessOnNarrowerFaces) {
  const double per_mass = 1 / (2 * 0.15 * 100);
  double last = 0;
  for (const double breadth : {16.1, 15.9, 12.0, 8.0, 4.0}) {
    const domain::Problem problem = Bar(breadth);
    const double mass = problem.part(kBlock).model->mass().mass;
    const double ratio = HoldingRatio(problem) / mass;
    EXPECT_GE(ratio, (kGravity + plan::kCarryingAcceleration) * per_mass);
    if (breadth == 15.9) {
      EXPECT_NEAR(ratio, last, 0.05 * last);
    }
    EXPECT_GT(ratio, last * 0.95) << breadth;
    last = ratio;
  }
}

// The patch moves with the part. What an error may bring beyond the pads does not count.
TEST(NarrowGrip, AnErrorAlongThePadsCostsOnlyWhatMayLeaveThem) {
  const domain::Problem problem = Bar(8);
  const double exact = HoldingRatio(problem);
  EXPECT_LT(HoldingRatio(problem, {.x = 0.003, .z = 0}), 2 * exact);
  EXPECT_GT(HoldingRatio(problem, {.x = 0.007, .z = 0}), 2 * exact);
  EXPECT_GT(HoldingRatio(problem, {.x = 0.009, .z = 0}), 1000);
}

// Pads turn a bar until its faces lie flat unless its contacts may be within the friction cones.
TEST(NarrowGrip, ABarMayJamIfItIsNarrow) {
  const Errors errors{.length = 0.001, .angle = 0.03, .hand = 1e-4};
  EXPECT_EQ(Close(Bar(16.1, errors)).skew, 0);
  EXPECT_EQ(Close(Bar(12, errors)).skew, 0);
  const Closed jammed = Close(Bar(5, errors));  // atan(5 / 40) < atan(0.15)
  EXPECT_GE(jammed.skew, errors.angle);
  EXPECT_FALSE(jammed.is_round);
  EXPECT_GT(jammed.holding, 1000);
}

// Returns the turn of a bar on which pads without friction have closed. The bar turns as long as
// this brings the pads nearer to each other.
double TurnAfterClosing(double breadth, double turn) {
  constexpr double kStep = 1e-3;  // radians
  const auto apart = [&](double angle) {
    return kWidth * std::cos(angle) + breadth * std::abs(std::sin(angle));
  };
  while (std::abs(turn) > kStep && std::abs(turn) < M_PI / 2 - kStep) {
    turn += apart(turn + kStep) < apart(turn - kStep) ? kStep : -kStep;
  }
  return turn;
}

// Pads may turn a part far away that is turned too far, whether or not they are wider than its
// faces. They turn no part away whose faces are long enough.
TEST(NarrowGrip, ABarThatIsTurnedTooFarMayTurnAway) {
  RandomStream random(kSeed, "turned away");
  for (const double breadth : {8.0, 15.9, 16.1, 30.0}) {
    const double steepest = std::atan(breadth / 1000 / kWidth);
    for (const double angle : {0.5 * steepest, 0.8 * steepest, 1.2 * steepest}) {
      const Errors errors{.length = 0.001, .angle = angle, .hand = 1e-4};
      const double most = Close(Bar(breadth, errors, 0.05)).skew;
      double reached = 0;
      for (int trial = 0; trial < 200; ++trial) {
        const double turn = TurnAfterClosing(breadth / 1000, random.Uniform(-angle, angle));
        ASSERT_LE(std::abs(turn), most + 2e-3) << breadth << " mm, seed " << kSeed;
        reached = std::max(reached, std::abs(turn));
      }
      EXPECT_EQ(reached > 1, angle > steepest) << breadth << " mm";
      if (breadth > 2000 * kPad) {
        EXPECT_EQ(most > 1, angle > steepest) << breadth << " mm";
      }
    }
  }
}

// Closes pads without friction on a bar, in small steps. Both pads move equally, so the bar turns
// about a point midway between its contacts along the pads. Its height is anywhere between the
// pads, because it depends on what friction does. Returns how far the bar's middle is then along
// the pads.
double MiddleAfterClosing(double half_breadth, Vector2 middle, double turn, RandomStream& random) {
  constexpr int kSteps = 400;
  const double pivot = random.Uniform(-kWidth / 2, kWidth / 2);
  const double step = turn / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Eigen::Rotation2Dd R(turn - i * step);
    const double side = turn > 0 ? -1 : 1;  // of the corner that the upper pad meets
    const double upper = (R * Vector2(side * half_breadth, kWidth / 2)).x() + middle.x();
    const double lower = (R * Vector2(-side * half_breadth, -kWidth / 2)).x() + middle.x();
    const double between = (std::clamp(upper, -kPad, kPad) + std::clamp(lower, -kPad, kPad)) / 2;
    const Vector2 about(between, pivot);
    middle = about + Eigen::Rotation2Dd(-step) * (middle - about);
    middle.y() = 0;
  }
  return middle.x();
}

TEST(NarrowGrip, ABarSlipsNoFartherThanItsErrorSetSays) {
  const Errors errors{.length = 0.002, .angle = 0.05, .hand = 0};
  RandomStream random(kSeed, "bars");
  for (const double breadth : {8.0, 12.0, 15.0}) {
    const double most = Close(Bar(breadth, errors, 0.05)).x;
    double reached = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      const Vector2 middle(random.Uniform(-errors.length, errors.length), 0);
      const double turn = random.Uniform(-errors.angle, errors.angle);
      const double x = MiddleAfterClosing(breadth / 2000, middle, turn, random);
      ASSERT_LE(std::abs(x), most) << breadth << " seed " << kSeed << " trial " << trial;
      reached = std::max(reached, std::abs(x));
    }
    EXPECT_GE(reached, 0.7 * most);
  }
}

// A round part keeps its turn, comes midway between the pads, and is held.
TEST(RoundGrip, KeepsItsTurnAndIsHeld) {
  const Errors errors{.length = 0.001, .angle = 0.05, .hand = 1e-4};
  const domain::Problem problem = Cylinder(64, errors);
  const Closed closed = Close(problem);
  EXPECT_TRUE(closed.is_round);
  // The first pad may turn the part until its next face lies flat.
  EXPECT_GE(closed.skew, errors.angle + M_PI / 64);
  EXPECT_LT(closed.skew, 8 * errors.angle);
  EXPECT_EQ(closed.y, 0);
  EXPECT_GE(closed.x, errors.length);
  EXPECT_LT(closed.x, 2 * errors.length);
  const double mass = problem.part(kBlock).model->mass().mass;
  const double friction = 2 * 0.15 * 100;
  EXPECT_GE(closed.holding, mass * (kGravity + plan::kCarryingAcceleration) / friction +
                                std::tan(M_PI / 64) / 0.15);
  EXPECT_LT(closed.holding, 1);
}

// When smooth pads close on a polygon with few sides, they turn it until the nearest of its faces
// lies flat on them. How the part slips meanwhile is not bounded.
TEST(RoundGrip, ACoarsePolygonIsNotHeldLikeACircle) {
  const Errors errors{.length = 0.001, .angle = 0.05, .hand = 1e-4};
  EXPECT_FALSE(Close(Cylinder(64, errors, 0.04)).is_round);  // tan(180 / 64) = 0.049
  EXPECT_FALSE(Close(Cylinder(16, errors)).is_round);
  EXPECT_TRUE(Close(Cylinder(24, errors)).is_round);
}

// If a corner of the polygon may lie beside the pad, the pad's edge presses on the face beside the
// corner. The axis then does not come midway between the pads.
TEST(RoundGrip, CornersThatMayLieBesideThePadsAreNotHeldLikeACircle) {
  const auto is_round = [](double length) {
    return Close(Cylinder(12, {.length = length, .angle = 0.05, .hand = 0}, 0.3)).is_round;
  };
  const double corner = kWidth / 2 * std::tan(M_PI / 12);  // from the middle of the pads
  EXPECT_TRUE(is_round((kPad - corner) / 2));
  EXPECT_FALSE(is_round(kPad - corner));
}

// A push that goes by the centre of mass turns the part. The axis moves aside by as much as it
// turns about the centre of mass. The turn is least if the whole weight bears on the farthest
// corner (Mason 1986).
TEST(RoundGrip, APartWhoseMassIsBesideItsAxisSlipsFarther) {
  constexpr double kSmooth = 0.02;
  const Errors errors{.length = 0.001, .angle = 0.001, .hand = 0};
  const domain::Problem problem = Standing(
      "{cylinder: {from: [0, 0, 10], to: [0, 0, 100], radius: 20, sides: 200}}\n"
      "  base: {box: [[-30, -30, 0], [80, 80, 10]]}",
      errors, kSmooth);
  const Closed closed = Close(problem);
  ASSERT_TRUE(closed.is_round);
  const Vector3 center = problem.part(kBlock).model->mass().center;
  ASSERT_GT(center.x(), 0.005);
  const double farthest = (Vector2(center.head<2>()) - Vector2(-0.03, -0.03)).norm();
  const double aside =
      errors.length * center.x() * center.y() / (farthest * farthest + center.x() * center.x());
  EXPECT_GE(closed.x, errors.length + kSmooth * errors.length + aside);
  EXPECT_LT(closed.x, 4 * errors.length);
}

// The moment about the line of contact is borne by opposite friction at the two pads, with the
// diameter as their lever.
TEST(RoundGrip, BearsAMomentAboutItsAxis) {
  domain::Problem problem = Cylinder(64, {.length = 0.001, .angle = 0.05, .hand = 1e-4});
  const double before = Close(problem).holding;
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.grip_force = 50;
  problem.workcell = problem.workcell->WithRules(rules);
  const double wedging = std::tan(M_PI / 64) / 0.15;
  EXPECT_NEAR(Close(problem).holding - wedging, 2 * (before - wedging), 0.2 * (before - wedging));
}

}  // namespace
}  // namespace assay::uncertainty::narrow_grip_test
