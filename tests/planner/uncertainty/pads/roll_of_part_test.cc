#include "planner/uncertainty/pads/roll_of_part.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>

#include "planner/domain/parts/part_file.h"
#include "planner/domain/parts/part_model.h"
#include "planner/geometry/pose.h"
#include "tests/planner/uncertainty/part_on_table.h"
#include "tests/scratch_file.h"

namespace assay::uncertainty::roll_of_part_test {
namespace {

constexpr TurnedPart kTurned = {.turn = 0.01, .hand_turn = 0, .off = 0};  // radians, metres
constexpr double kHalfLength = 0.04;                                      // of the bar, metres

struct Bar {
  double half_width = 0.01;  // metres, of the ends of the face on which it lies
  double bulge = 0;          // metres by which it is wider in the middle, on each side
  double foot = 0;           // half the width of a foot under the bar, metres; 0: it has none
  double table_friction = 0.3;
};

std::shared_ptr<const domain::PartModel> ModelOf(const Bar& bar) {
  const double widest = bar.half_width + std::max(bar.bulge, 1e-4);
  const std::filesystem::path file = ScratchFile(
      fmt::format("bar-{}-{}-{}-{}.yaml", bar.half_width, bar.bulge, bar.foot, bar.table_friction));
  const std::string foot =
      bar.foot == 0 ? ""
                    : fmt::format("  foot: {{box: [[-{0}, -{1}, 0], [{0}, {1}, 0.005]]}}\n",
                                  kHalfLength, bar.foot);
  std::ofstream(file) << fmt::format(R"(format: assay-part/1
name: bar
initial: B
units: {{length: m, angle: degree}}
density: 700
friction: {3}
solids:
  bar: {{prism: {{outline: [[{0}, -{1}], [{0}, {1}], [0, {2}], [-{0}, {1}], [-{0}, -{1}], [0, -{2}]],
         axis: z, from: {4}, to: 0.03}}}}
{5}features:
  1: {{face: bar, normal: [0, 0, 1], what: top}}
stable_poses: {{flat: [0, 0, -1]}}
)",
                                     kHalfLength, bar.half_width, widest, bar.table_friction,
                                     bar.foot == 0 ? 0 : 0.005, foot);
  return domain::PartFile::Load(file, 0.001);
}

// Returns the roll of the bar, which lies flat. The pads close on its ends at half its height, in a
// hand that leans by `lean` radians. The pads are squares of 16 mm.
// The pads are `aside` metres from the middle of the ends.
Roll RollOf(const Bar& bar, double pad_friction, double lean, const TurnedPart& turned = kTurned,
            double aside = 0) {
  domain::Problem problem = UprightBlock({});
  problem.parts[kBlock.index()].model = ModelOf(bar);
  domain::WorkcellRules rules = problem.workcell->rules();
  rules.pad_friction = pad_friction;
  problem.workcell = problem.workcell->WithRules(rules);
  const UncertainWorld world(problem, Propagation::kSound);
  plan::Hold hold = HoldFromAbove(problem, Vector3::UnitX());
  hold.X_PartTool.translation() = Vector3(0, aside, 0.015);
  hold.X_PartTool = hold.X_PartTool * geometry::RotationY(lean);
  hold.width = 2 * kHalfLength;
  return RollOfPart(world, kBlock, hold, turned);
}

// The centre of mass is 10 mm from the long edges of the support and 40 mm from its ends. Pads with
// a friction of more than 10 / 40 move the pressure to a long edge before it comes to an end. Pads
// with less friction lift the bar at an end.
TEST(RollOfPart, ABarRollsIfThePadsFrictionLeadsToItsLongEdges) {
  EXPECT_LT(RollOf({}, 0.22, 0.5).angle, 0.1 * kTurned.turn);
  EXPECT_NEAR(RollOf({}, 0.28, 0.5).angle, kTurned.turn / 0.28, 1e-12);
  EXPECT_NEAR(RollOf({.half_width = 0.04}, 0.30, 0.5).angle, kTurned.turn * kTurned.turn, 1e-4);
}

// The grasped point is 15 mm above the support, and 10 mm beside its long edges.
TEST(RollOfPart, TheGraspedPointMovesAboutTheFarthestEdge) {
  const Roll roll = RollOf({}, 0.28, 0.5);
  EXPECT_NEAR(roll.way, roll.angle * std::hypot(0.015, 0.01), 0.01 * roll.way);
}

// A bar on a foot of 6 mm rolls if the pressure moves by more than 3 mm. If the foot slides almost
// without friction, the pads turn the bar before they press. Pads that may jam press as hard as
// they can, whatever the friction.
TEST(RollOfPart, ThePadsPressNoHarderThanTheSupportsFrictionRequires) {
  EXPECT_EQ(RollOf({.foot = 0.003, .table_friction = 1e-3}, 0.12, 0.5).angle, 0);
  EXPECT_GT(RollOf({.foot = 0.003, .table_friction = 0.8}, 0.12, 0.5).angle, kTurned.turn);
  EXPECT_GT(RollOf({.half_width = 0.003, .table_friction = 1e-3}, 0.12, 0.5).angle, kTurned.turn);
}

// Pads whose edges are upright touch the part along lines. The part tilts only as far as an error
// of the hand tilts the pads: while the part turns, and when its faces lie flat. The pressure
// arrives at edges that run 40 mm along the closing direction and 80 mm across it.
TEST(RollOfPart, ObliqueEndsTurnAShareOfTheHandsTiltIntoRoll) {
  const TurnedPart tilted = {.turn = 0.001, .hand_turn = 0.0005, .off = 0};
  const Bar bar = {.half_width = 0.002, .bulge = 0.08};
  const double upright = std::numbers::pi / 2;
  EXPECT_NEAR(RollOf(bar, 0.1, upright, tilted).angle, 2 * 0.0005 * 40 / 80, 2e-6);
  EXPECT_EQ(RollOf(bar, 0.1, upright, {.turn = 0.001}).angle, 0);
}

// The pads of 16 mm hold the bar between 12 and 28 mm beside its middle, and its foot reaches 3 mm.
// As the hand tilts the part onto an end of its foot, one of the two contacts rises by the tilt
// times 80 mm, and the other one stays. Contacts that are 16 mm from each other slide by as much
// together, if the part rolls by 80 / 16 times the tilt.
TEST(RollOfPart, PadsBesideTheSupportTurnTheHandsTiltIntoRoll) {
  const TurnedPart tilted = {.turn = 0.0005, .hand_turn = 0.0005, .off = 0};
  const Bar bar = {.half_width = 0.03, .foot = 0.003, .table_friction = 1e-3};
  const double upright = std::numbers::pi / 2;
  EXPECT_NEAR(RollOf(bar, 0.05, upright, tilted, 0.02).angle, 0.0005 * 80 / 16, 1e-5);
  EXPECT_NEAR(RollOf({.half_width = 0.04}, 0.05, upright, tilted, 0.02).angle, 0, 1e-6);
}

TEST(RollOfPart, APartThatIsNotTurnedDoesNotRoll) { EXPECT_EQ(RollOf({}, 0.28, 0.5, {}).angle, 0); }

}  // namespace
}  // namespace assay::uncertainty::roll_of_part_test
