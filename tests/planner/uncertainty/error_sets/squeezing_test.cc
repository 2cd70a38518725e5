#include "planner/uncertainty/error_sets/squeezing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "planner/domain/parts/part_file.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/planner/uncertainty/part_on_table.h"
#include "tests/scratch_file.h"

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

// Returns a thin wall on one side of a plate: pads that close on the wall have the part's centre of
// mass some 50 mm beside them, in the direction in which they close.
std::shared_ptr<const domain::PartModel> PlateWithWall(int density = 700) {
  const std::filesystem::path file = ScratchFile("plate-with-wall.yaml");
  std::ofstream(file) << fmt::format(R"(format: assay-part/1
name: plate-with-wall
initial: W
units: {{length: mm, angle: degree}}
density: {}
friction: 0.5
solids:
  plate: {{box: [[-55, -30, 0], [55, 130, 8]], color: [1, 1, 1, 1]}}
  wall: {{box: [[-12, -6, 8], [12, 6, 34]], color: [1, 1, 1, 1]}}
features:
  1: {{face: wall, normal: [0, 0, 1], what: top}}
stable_poses: {{flat: [0, 0, -1]}}
)",
                                     density);
  return domain::PartFile::Load(file, 0.001);
}

plan::Hold HoldOnWall(const domain::Problem& problem) {
  plan::Hold hold = HoldFromAbove(problem, Vector3::UnitY());
  hold.X_PartTool.translation() = Vector3(0, 0, 0.022);
  hold.width = 0.012;
  return hold;
}

double SlipOnWall(double pad_friction) {
  domain::Problem problem = UprightBlock({.length = 0, .angle = 0.02, .hand = 0});
  problem.parts[kBlock.index()].model = PlateWithWall();
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.pad_friction = pad_friction;
  problem.workcell = problem.workcell->WithRules(rules);
  UncertainWorld world(problem, Propagation::kSound);
  return Magnitude(world.TightRangeOf(CloseOn(world, HoldOnWall(problem)).x));
}

// Slippery pads let the table's friction turn the part about its centre of mass, 50 mm off. Pads
// with more friction than a / 50 mm, a being half their length, hold the point of the turn between
// them.
TEST(ClosePads, SlipperyPadsTurnThePartAboutItsCentreOfMass) {
  const double center = PlateWithWall()->mass().center.y();
  ASSERT_GT(center, 0.04);
  const double a = UprightBlock({}).workcell->gripper().pad_half_extents().x();
  EXPECT_GE(SlipOnWall(0.2 * a / center), center * std::sin(0.02));
  EXPECT_LT(SlipOnWall(2 * a / center), 0.5 * center * std::sin(0.02));
}

// Returns the error that is left after pads have closed on the plate's wall with this force.
struct HeldPlate {
  double y = 0;     // metres
  double skew = 0;  // radians
};
HeldPlate CloseOnPlate(int density, double grip_force, const Errors& errors) {
  domain::Problem problem = UprightBlock(errors);
  problem.parts.resize(1);
  problem.parts[kBlock.index()].model = PlateWithWall(density);
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.grip_force = grip_force;
  problem.workcell = problem.workcell->WithRules(rules);
  UncertainWorld world(problem, Propagation::kSound);
  const HeldError held = CloseOn(world, HoldOnWall(problem));
  return {Magnitude(world.TightRangeOf(held.y)), Magnitude(world.TightRangeOf(held.skew))};
}

// The push that overcomes the friction of a part's support also moves the hand, in proportion to
// the weight. The friction of a plate of 0.1 kg moves it by less than counts.
TEST(ClosePads, TheFrictionOfAHeavyPartMovesTheHand) {
  constexpr double kGrip = 10000;  // newtons, so that the pads do not jam
  const Errors errors{.length = 0.001, .angle = 0.01};
  EXPECT_EQ(CloseOnPlate(700, kGrip, errors).y, 0);
  const double give = CloseOnPlate(20000, kGrip, errors).y;
  const double push = 0.5 * 9.81 * PlateWithWall(20000)->mass().mass;
  EXPECT_GT(give, 1e-7 * push);
  EXPECT_LT(give, 4e-6 * push) << "an arm that is not braced yields by this";
  EXPECT_NEAR(CloseOnPlate(40000, kGrip, errors).y, 2 * give, 0.01 * give);
  EXPECT_EQ(CloseOnPlate(20000, kGrip, {.length = 0, .angle = 0, .hand = 0}).y, 0)
      << "nothing is pushed";
}

// Pads of length L turn the plate back with a moment of at most L times the grip. The friction of
// the table resists with up to the friction times the weight times the farthest corner's distance.
// Its mean distance is at least a third of this.
TEST(ClosePads, JamIfTheSupportsFrictionResistsTheGrip) {
  constexpr int kDensity = 7000;
  const Errors errors{.length = 0.0001, .angle = 0.01};
  const std::shared_ptr<const domain::PartModel> plate = PlateWithWall(kDensity);
  const double length = 2 * UprightBlock({}).workcell->gripper().pad_half_extents().x();
  const double moment = 0.5 * 9.81 * plate->mass().mass * std::hypot(0.055, 0.13);
  EXPECT_GE(CloseOnPlate(kDensity, moment / length / 3, errors).skew, errors.angle);
  EXPECT_EQ(CloseOnPlate(kDensity, 3 * moment / length, errors).skew, 0);
}

// Returns a post with two opposite upright faces of this width, 30 mm apart.
std::shared_ptr<const domain::PartModel> PostWithFaces(double width_mm) {
  const std::filesystem::path file = ScratchFile(fmt::format("post-{}.yaml", width_mm));
  std::ofstream(file) << fmt::format(R"(format: assay-part/1
name: post
initial: P
units: {{length: mm, angle: degree}}
density: 700
friction: 0.1
solids:
  base: {{box: [[-40, -40, 0], [40, 40, 20]]}}
  post: {{prism: {{outline: [[-15, -{0}], [0, -25], [15, -{0}], [15, {0}], [0, 25], [-15, {0}]],
          axis: z, from: 20, to: 90}}}}
features:
  1: {{face: post, normal: [0, 0, 1], what: top}}
stable_poses: {{upright: [0, 0, -1]}}
)",
                                     width_mm / 2);
  return domain::PartFile::Load(file, 0.001);
}

// Returns how far the post may stay turned between pads of a hand that leans by this angle. The
// post comes with a turn of 3 degrees. Faces of 4 mm are as wide as 0.13 times their distance, and
// faces of 20 mm as 0.67 times. Two contacts at opposite ends of narrow faces are within friction
// cones of 0.25.
double TurnBetweenPads(double face_mm, double lean) {
  domain::Problem problem = UprightBlock({.length = 0, .angle = 0.0524, .hand = 0});
  problem.parts[kBlock.index()].model = PostWithFaces(face_mm);
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.pad_friction = 0.25;
  problem.workcell = problem.workcell->WithRules(rules);
  UncertainWorld world(problem, Propagation::kSound);
  plan::Hold hold = HoldFromAbove(problem, Vector3::UnitX());
  hold.X_PartTool.translation() = Vector3(0, 0, 0.06);
  hold.X_PartTool = hold.X_PartTool * geometry::RotationY(lean);
  hold.width = 0.03;
  const HeldError held = CloseOn(world, hold);
  return Magnitude(world.TightRangeOf(held.skew)) + Magnitude(world.TightRangeOf(held.tip));
}

// A part turns about the vertical, however the hand leans. A narrow upright face therefore jams
// between leaning pads as it does between upright ones.
TEST(ClosePads, NarrowFacesJamHoweverTheHandLeans) {
  for (const double lean : {0.0, 0.3, 0.7, -0.7}) {
    EXPECT_GT(TurnBetweenPads(4, lean), 0.02) << lean;
    EXPECT_EQ(TurnBetweenPads(20, lean), 0) << lean;
  }
}

}  // namespace
}  // namespace assay::uncertainty::squeezing_test
