#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "planner/domain/parts/part_file.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/plan/certificates/pushing.h"
#include "planner/uncertainty/error_sets/possible_masses.h"
#include "planner/uncertainty/error_sets/squeezing.h"
#include "planner/uncertainty/preconditions/precondition.h"
#include "planner/uncertainty/standing/support.h"
#include "tests/planner/domain/scenario.h"
#include "tests/planner/uncertainty/part_on_table.h"
#include "tests/scratch_file.h"

namespace assay::uncertainty::standing_test {
namespace {

constexpr double kPad = 0.008;  // least half extent of a pad, metres

// Spar's block, 3 by 3 inches and 6.5 inches high. It stands on its end, with its origin in the
// middle of its side along y.
struct OnEnd {
  domain::Problem problem = UprightBlock({});
  UncertainWorld world{problem, Propagation::kSound};
  const Pose& X_WorldPart() const { return problem.part(kBlock).X_WorldPart; }
  double Weight() const { return GreatestWeight(problem, kBlock); }
  Vector3 Center() const { return X_WorldPart() * problem.part(kBlock).model->mass().center; }
};

Push Down(const Vector3& at, double newtons) { return {{at}, newtons, 0}; }

// The ratio is exact. It is the push times its lever beyond the edge, over the weight times its
// lever inside the edge.
TEST(Support, APushBeyondAnEdgeIsHeldByTheWeight) {
  const OnEnd block;
  const double edge = block.X_WorldPart().translation().x() + 3 * kInch;
  const Vector3 at(edge + 0.01, block.Center().y(), 0.1);
  const double ratio = TippingRatio(block.world, kBlock, {Down(at, 20)}, 0);
  EXPECT_NEAR(ratio, 20 * 0.01 / (block.Weight() * (edge - block.Center().x())), 1e-9);
  EXPECT_EQ(TippingRatio(block.world, kBlock, {Down(block.Center(), 1000)}, 0), 0);
  EXPECT_NEAR(TippingRatio(block.world, kBlock, {Down(at - Vector3(0.005, 0, 0), 20)}, 0.005),
              ratio, 1e-9)
      << "what may be elsewhere is";
}

TEST(Support, AClampHoldsBesides) {
  OnEnd block;
  const Push push = {{block.Center() + Vector3(0.05, 0, 0)}, 20, 3};
  const double free = TippingRatio(block.world, kBlock, {push}, 0);
  const double sliding = SlidingRatio(block.world, kBlock, {push});
  block.problem.parts[kBlock.index()].clamp = block.Weight();
  const UncertainWorld clamped(block.problem, Propagation::kSound);
  EXPECT_NEAR(TippingRatio(clamped, kBlock, {push}, 0), free / 2, 1e-9);
  const double least = block.problem.part(kBlock).model->friction();
  EXPECT_NEAR(3 / sliding, least * (20 + block.Weight()), 1e-9);
  EXPECT_NEAR(3 / SlidingRatio(clamped, kBlock, {push}), least * (20 + 2 * block.Weight()), 1e-9);
}

// Two blocks: the upper one stands on the end of the lower one, half an inch to the side.
TEST(Support, WhatStandsOnAnotherPassesItsPushOn) {
  domain::Problem problem = UprightBlock({});
  domain::Part upper = problem.part(kBlock);
  upper.name = "upper";
  upper.X_WorldPart = geometry::Translation(kInch / 2, 0, 6.5 * kInch) * upper.X_WorldPart;
  problem.parts.push_back(upper);
  for (domain::Part& part : problem.parts) part.error = {};
  const PartId top(static_cast<int>(problem.parts.size()) - 1);
  const UncertainWorld world(problem, Propagation::kSound);
  const std::vector<Standing> standings = StandingsOf(world, top, upper.X_WorldPart);
  ASSERT_EQ(standings.size(), 1);
  EXPECT_EQ(standings.front().on, kBlock);
  for (const Vector3& p : standings.front().at) EXPECT_NEAR(p.z(), 6.5 * kInch, 1e-9);
  EXPECT_EQ(TippingEdgesOf(standings).size(), 4);
  // No part of the upper block is beyond the edges of the lower one, and it stands by itself.
  EXPECT_NEAR(TippingRatio(world, top, {}, 0), 0, 1e-6);
  const Vector3 beyond = upper.X_WorldPart * Vector3(3 * kInch, 0, 0);
  EXPECT_GT(TippingRatio(world, top, {Down(beyond, 5)}, 0), 0);
}

// The upper block stands with its edge 2 mm inside of the lower one's edge. If the blocks may be
// displaced against each other by more than that, it is not sure that this edge bears anything.
TEST(Support, DisplacedPartsBearLess) {
  const auto ratio = [](double error) {
    domain::Problem problem = UprightBlock({});
    domain::Part upper = problem.part(kBlock);
    upper.name = "upper";
    upper.X_WorldPart = geometry::Translation(0, 0, 6.5 * kInch) * upper.X_WorldPart;
    problem.parts.push_back(upper);
    for (domain::Part& part : problem.parts) part.error = {};
    problem.parts.back().error.x = {-error, error};
    const UncertainWorld world(problem, Propagation::kSound);
    const PartId top(static_cast<int>(problem.parts.size()) - 1);
    const Vector3 edge = upper.X_WorldPart * Vector3(0, 0, 0);
    return TippingRatio(world, top, {Down(edge + Vector3(0.3, 0, 0), 0.1)}, 0);
  };
  EXPECT_GT(ratio(0.002), ratio(0));
  EXPECT_GT(ratio(0.01), ratio(0.002));
  EXPECT_EQ(ratio(1), kNothingBorne) << "the blocks may be a metre apart";
}

double RatioOf(const UncertainWorld& world, const std::vector<Precondition>& conditions,
               plan::Condition condition) {
  for (const Precondition& c : conditions) {
    if (c.condition == condition) return world.RangeOf(c.expression).high;
  }
  ADD_FAILURE() << "no " << condition.name();
  return 0;
}

struct Closing {
  domain::Problem problem;
  std::vector<Precondition> conditions;
  double upright = 0;
};

Closing Close(const domain::Problem& problem, const plan::Hold& hold) {
  UncertainWorld world(problem, Propagation::kSound);
  const ManipulatorError draw = world.DrawManipulator();
  const HeldError held = ClosePads(world, kBlock, hold, draw);
  Closing closing = {problem, ClosingPreconditions(world, kBlock, hold, draw, held), 0};
  closing.upright = RatioOf(world, closing.conditions, plan::condition::kUpright);
  return closing;
}

plan::Hold HoldAtHeight(const domain::Problem& problem, double height) {
  plan::Hold hold = HoldFromAbove(problem, Vector3::UnitY());
  hold.X_PartTool.translation().z() = height;
  return hold;
}

// Friction pushes at the table, and the pad pushes with its lower edge. The block topples if
// friction times height exceeds half of its depth.
TEST(Upright, FrictionTimesHeightOverHalfTheDepth) {
  const domain::Problem problem = UprightBlock({.length = 0.0002, .angle = 0.001, .hand = 1e-5});
  const double friction = problem.part(kBlock).model->friction();
  for (const double height : {0.05, 0.1, 0.14}) {
    const double ratio = Close(problem, HoldAtHeight(problem, height)).upright;
    EXPECT_GT(ratio, friction * (height - 2 * kPad) / (1.5 * kInch));
    EXPECT_LT(ratio, friction * (height + 0.002) / (1.5 * kInch));
  }
}

TEST(Upright, NothingIsPushedWhereNothingErrs) {
  const domain::Problem exact = UprightBlock({.length = 0, .angle = 0, .hand = 0});
  EXPECT_EQ(Close(exact, HoldAtHeight(exact, 0.15)).upright, 0);
}

TEST(Upright, RougherTablesToppleMore) {
  domain::Problem problem = UprightBlock({.length = 0.0002, .angle = 0.001, .hand = 1e-5});
  const double said = Close(problem, HoldAtHeight(problem, 0.1)).upright;
  problem.tolerances.friction = problem.part(kBlock).model->friction();
  EXPECT_NEAR(Close(problem, HoldAtHeight(problem, 0.1)).upright, 2 * said, 1e-9);
}

// The block slides only if the pad pushes with friction times its weight.
TEST(Upright, AGripThatIsWeakerThanFrictionMovesNothing) {
  domain::Problem problem = UprightBlock({.length = 0.0002, .angle = 0.001, .hand = 1e-5});
  const double friction = problem.part(kBlock).model->friction() * GreatestWeight(problem, kBlock);
  for (const double share : {0.5, 0.99, 1.01}) {
    domain::WorkcellRules rules = problem.workcell->rules();
    rules.grip_force = share * friction;
    problem.workcell = problem.workcell->WithRules(rules);
    EXPECT_NEAR(Close(problem, HoldAtHeight(problem, 0.02)).upright, 1 / share, 1e-3);
  }
}

TEST(NeighbourClear, GoesDownAsANeighbourComesNearer) {
  domain::Problem problem = UprightBlock({.length = 0.002, .angle = 0.01, .hand = 1e-4});
  ASSERT_EQ(problem.parts.size(), 2);
  const auto room_at = [&](double gap) {
    problem.parts[1] = problem.parts[0];
    problem.parts[1].error = {};
    problem.parts[1].X_WorldPart =
        geometry::Translation(3 * kInch + gap, 0, 0) * problem.parts[0].X_WorldPart;
    const Closing closing = Close(problem, HoldAtHeight(problem, 0.1));
    return RatioOf(UncertainWorld(problem, Propagation::kSound), closing.conditions,
                   plan::condition::kPushedClear);
  };
  EXPECT_NEAR(room_at(0.05) - room_at(0.02), 0.03, 1e-9);
  EXPECT_LT(room_at(0.002), 0) << "the part itself may be as far aside";
  EXPECT_GT(room_at(0.05), 0.05 - 0.01) << "errors of millimetres";
}

// Returns a T that stands on its stem of one square inch, with a bar of 6 inches.
std::shared_ptr<const domain::PartModel> LetterT() {
  const std::filesystem::path file = ScratchFile("letter-t.yaml");
  std::ofstream(file) << R"(format: assay-part/1
name: letter-t
initial: T
units: {length: inch, angle: degree}
density: 700
friction: 0.25
solids:
  stem: {box: [[-0.5, -0.5, 0], [0.5, 0.5, 2]], color: [1, 1, 1, 1]}
  bar: {box: [[-3, -0.5, 2], [3, 0.5, 3]], color: [1, 1, 1, 1]}
features:
  1: {face: bar, normal: [0, 0, 1], what: top}
stable_poses: {upside-down: [0, 0, 1]}
)";
  return domain::PartFile::Load(file, 0.001);
}

// Returns the ratio of "pads that press" if the pads hold the T `aside` of its middle (metres).
double PressedAside(double aside, double grip_force) {
  domain::Problem problem = UprightBlock({});
  domain::Part& part = problem.parts[kBlock.index()];
  part.model = LetterT();
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.grip_force = grip_force;
  problem.workcell = problem.workcell->WithRules(rules);
  UncertainWorld world(problem, Propagation::kSound);
  plan::Hold hold = HoldFromAbove(problem, Vector3::UnitY());
  hold.X_PartTool.translation() = Vector3(aside, 0, 2.5 * kInch);
  hold.width = kInch;
  world.SetHeld(kBlock, {.x = 0, .z = 0});
  const ManipulatorError draw = world.DrawManipulator();
  const auto conditions =
      StandingPreconditions(world, kBlock, hold, draw, part.X_WorldPart, {{0, 0, 0}, 0}, 0);
  EXPECT_EQ(RatioOf(world, conditions, plan::condition::kStanding), 0) << "it comes upright";
  return RatioOf(world, conditions, plan::condition::kPressed);
}

// Weak pads press with their greatest force at their own distance beyond the stem. Strong pads must
// bear the reaction of the stem's edge. The ratio is then at least the torsion of that push over
// the torsion that their friction bears, by its mean distance.
TEST(Pressed, PadsBesideTheSupportTipItOrBearIt) {
  const double weight = LetterT()->mass().mass * kGravity;
  const domain::Problem problem = UprightBlock({});
  const double friction = problem.workcell->rules().pad_friction;
  const double a = problem.workcell->gripper().pad_half_extents().x();
  const double aside = 2 * kInch;
  const double beyond = aside - kInch / 2;
  EXPECT_EQ(PressedAside(0, 100), 0);
  EXPECT_NEAR(PressedAside(aside, 20), 2 * friction * 20 * beyond / (kInch / 2) / weight, 1e-9);
  // The torsion that a grip of one newton bears.
  const double torsion = 2 * friction * (std::sqrt(2.0) + std::asinh(1.0)) / 3 * a;
  for (const double force : {1000.0, 10000.0}) {
    const double ratio = PressedAside(aside, force);
    EXPECT_GE(ratio, plan::kResistance * beyond / (torsion * force));
    EXPECT_LE(ratio, 1.5 * plan::kResistance * beyond / (torsion * force));
  }
}

// The ratio is 1 if the tangent of the lean is the half width over the height of the centre of
// mass. A part that leans more would fall.
TEST(Standing, WhatLeansFallsBackUnlessItIsTooTall) {
  domain::Problem problem = UprightBlock({});
  domain::Part& part = problem.parts[kBlock.index()];
  part.model = LetterT();
  const plan::Hold hold = HoldFromAbove(problem, Vector3::UnitY());
  UncertainWorld world(problem, Propagation::kSound);
  world.SetHeld(kBlock, {.x = 0, .z = 0});
  const ManipulatorError draw = world.DrawManipulator();
  const double steep = kInch / 2 / part.model->mass().center.z();
  for (const double share : {0.5, 0.99, 1.01, 2.0}) {
    const auto conditions = StandingPreconditions(world, kBlock, hold, draw, part.X_WorldPart,
                                                  {{0, 0, 0}, 0}, std::atan(share * steep));
    EXPECT_NEAR(RatioOf(world, conditions, plan::condition::kStanding), share, 1e-9);
  }
}

// A shaft that goes through a hole ends on the table. The frame is pressed down at most around its
// hole, inside of what it stands on.
TEST(FixedPart, IsNotTippedByAShaftThatEndsOnTheTable) {
  const domain::Problem problem = domain::LoadScenario("key-bar");
  UncertainWorld world(problem, Propagation::kSound);
  const plan::Hold hold = HoldFromAbove(problem, Vector3::UnitY());
  const std::vector<Precondition> conditions =
      FixedPreconditions(world, domain::MatingId(0), hold, {0, 0, 0, 0}, {}, nullptr);
  EXPECT_LT(RatioOf(world, conditions, plan::condition::kFixedStands), 1e-6);
  EXPECT_LT(RatioOf(world, conditions, plan::condition::kFixedStays), 1e-6);
}

}  // namespace
}  // namespace assay::uncertainty::standing_test
