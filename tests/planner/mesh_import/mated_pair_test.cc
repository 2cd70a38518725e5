#include "planner/mesh_import/parts/mated_pair.h"
#include "tests/planner/mesh_import/scenario_of.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/input_files/document.h"
#include "planner/mesh_import/parts/part_import.h"
#include "tests/planner/mesh_import/made_mesh.h"

namespace assay::mesh_import {
namespace {

using ::testing::HasSubstr;

ImportedPart NamedPart(const std::string& name, TriangleMesh mesh, const Vector3& offset) {
  for (Vector3& vertex : mesh.vertices) vertex += offset;
  return Import({Written(name + ".obj", ObjText(mesh))}, name, {});
}

TEST(MatedPair, RoundPegInItsHole) {
  const ImportedPart plate =
      NamedPart("plate", Extruded(RectangleOf(40, 40), 12, {CircleOf(8.1, 48)}), {0, 0, 0});
  // The peg stands 2 mm above the other side and 0.03 mm off the axis.
  const ImportedPart peg = NamedPart("peg", ChamferedPeg(8, 50, 0.5, 48), {0.03, 0, 2});
  const std::optional<MatedPair> pair = FindMating(plate, peg);
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->held, &peg);
  EXPECT_EQ(pair->fixed, &plate);
  const MatedFeatures& mated = pair->features.front();
  ASSERT_EQ(mated.gaps.size(), 2u);
  EXPECT_NEAR(mated.gaps[0], 0.07e-3, 1e-7);
  EXPECT_NEAR(mated.gaps[1], 0.13e-3, 1e-7);
  EXPECT_NEAR(mated.depth, 10e-3, 1e-7);
  EXPECT_THAT(peg.sketch.features[static_cast<std::size_t>(mated.shaft - 1)].what,
              HasSubstr("tip toward -z"));
}

// A shaft may come into a hole that goes through from either side.
TEST(MatedPair, AThroughHoleHasTwoMouths) {
  const ImportedPart plate =
      NamedPart("plate", Extruded(RectangleOf(40, 40), 12, {CircleOf(8.1, 48)}), {0, 0, 0});
  for (const double side : {1.0, -1.0}) {
    const ImportedPart peg =
        NamedPart("peg", ChamferedPeg(8, 50, 0.5, 48), {0, 0, side > 0 ? 2.0 : -40.0});
    const std::optional<MatedPair> pair = FindMating(plate, peg);
    ASSERT_TRUE(pair);
    const MatedFeatures& mated = pair->features.front();
    EXPECT_NEAR(mated.depth, 10e-3, 1e-7);
    EXPECT_NEAR(mated.mouth.z(), side, 1e-9);
    EXPECT_NEAR(plate.sketch.features[static_cast<std::size_t>(mated.hole - 1)].direction.z(), side,
                1e-9);
    EXPECT_THAT(ScenarioOf(*pair),
                HasSubstr(side > 0 ? "mating_vector: [0, 0, -30]" : "mating_vector: [0, 0, 30]"));
  }
}

// A part that can stand as it is mated starts so. The hand can then keep it as it takes it.
TEST(MatedPair, APartStartsWithItsTipDown) {
  const ImportedPart plate =
      NamedPart("plate", Extruded(RectangleOf(40, 40), 12, {CircleOf(8.1, 48)}), {0, 0, 0});
  const ImportedPart peg = NamedPart("peg", ChamferedPeg(8, 50, 0.5, 48), {0, 0, 2});
  EXPECT_THAT(ScenarioOf(*FindMating(plate, peg)),
              HasSubstr("model: peg\n    pose: {down: [0, 0, -1], at: [0.5, -0.2]}"));
  const ImportedPart below = NamedPart("peg", ChamferedPeg(8, 50, 0.5, 48), {0, 0, -40});
  EXPECT_THAT(ScenarioOf(*FindMating(plate, below)),
              HasSubstr("model: peg\n    pose: {down: [0, 0, 1], at: [0.5, -0.2]}"));
}

TEST(MatedPair, TheHeldPartIsMovedToItsSeat) {
  const ImportedPart plate =
      NamedPart("plate", Extruded(RectangleOf(40, 40), 12, {CircleOf(8.1, 48)}), {0, 0, 0});
  const ImportedPart peg = NamedPart("peg", ChamferedPeg(8, 50, 0.5, 48), {0, 0, 0.2});
  MatedPair pair = FindMating(plate, peg).value();
  EXPECT_EQ(AccountOf(pair).size(), 1u);
  pair.way_to_seat = 0.2e-3;
  EXPECT_THAT(ScenarioOf(pair), HasSubstr("[0, 0, 1], [0, 0, -0.2]]}\n"
                                          "      mating_vector: [0, 0, -32]"));
  EXPECT_THAT(AccountOf(pair).back(), HasSubstr("moves it on by 0.2 mm"));
}

TEST(MatedPair, AHollowShaftIsAShaft) {
  const ImportedPart plate =
      NamedPart("plate", Extruded(RectangleOf(40, 40), 12, {CircleOf(8.1, 48)}), {0, 0, 0});
  const ImportedPart tube =
      NamedPart("tube", Extruded(CircleOf(8, 48), 50, {CircleOf(5, 48)}), {0, 0, 2});
  const std::optional<MatedPair> pair = FindMating(plate, tube);
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->held, &tube);
  EXPECT_NEAR(pair->features.front().LeastGap(), 0.1e-3, 1e-7);
}

// Polygons with n sides take r_shaft (1 / cos(180 degrees / n) - 1) and r_hole (1 - cos(180 degrees
// / n)) from the gap. With a gap of 0.09 mm they take 0.0206 mm with 44 sides, and 0.0250 with 40.
TEST(MatedPair, PolygonsTakeAtMostAQuarterOfARoundGap) {
  const auto sides = [](double gap) {
    const double diameter = 8 + 2 * gap;
    const ImportedPart plate =
        NamedPart("plate", Extruded(RectangleOf(40, 40), 12, {CircleOf(diameter, 96)}), {0, 0, 0});
    const ImportedPart peg = NamedPart("peg", ChamferedPeg(8, 50, 0.5, 96), {0, 0, 2});
    const std::optional<MatedPair> pair = FindMating(plate, peg);
    return pair ? SidesFor(*pair) : 0;
  };
  EXPECT_EQ(sides(0.09), 44);
  EXPECT_EQ(sides(0.3), 32);
  EXPECT_EQ(sides(0.001), 128);
}

TEST(MatedPair, RectangularGapsAreThoseOfEachSide) {
  const Curve hole = RectangleOf(10.3, 8.2, {0.05, 0});
  const ImportedPart block =
      NamedPart("block", BlockWithBlindHole(RectangleOf(40, 30), hole, 5, 25), {0, 0, 0});
  const ImportedPart peg = NamedPart("peg", Extruded(RectangleOf(10, 8), 50), {0, 0, 5});
  const std::optional<MatedPair> pair = FindMating(peg, block);
  ASSERT_TRUE(pair);
  std::vector<double> gaps = pair->features.front().gaps;
  std::ranges::sort(gaps);
  const std::vector<double> expected = {0.1e-3, 0.1e-3, 0.1e-3, 0.2e-3};
  ASSERT_EQ(gaps.size(), expected.size());
  for (std::size_t i = 0; i < gaps.size(); ++i) EXPECT_NEAR(gaps[i], expected[i], 1e-7);
  EXPECT_NEAR(pair->features.front().depth, 20e-3, 1e-7);
}

TEST(MatedPair, NoMatingElsewhere) {
  const TriangleMesh plate = Extruded(RectangleOf(40, 40), 12, {CircleOf(8.1, 48)});
  const TriangleMesh peg = ChamferedPeg(8, 50, 0.5, 48);
  const ImportedPart fixed = NamedPart("plate", plate, {0, 0, 0});
  EXPECT_FALSE(FindMating(fixed, NamedPart("beside", peg, {1, 0, 2})));
  EXPECT_FALSE(FindMating(fixed, NamedPart("above", peg, {0, 0, 13})));
  EXPECT_FALSE(FindMating(fixed, NamedPart("thick", ChamferedPeg(8.2, 50, 0.5, 48), {0, 0, 2})));
}

// Both parts stand on the table, and the hole looks up.
TEST(MatedPair, ScenarioHasBothPartsOnTheTable) {
  const TriangleMesh drilled =
      Extruded(RectangleOf(40, 40), 12, {CircleOf(8.1, 48)})
          .Transformed(Eigen::AngleAxisd(0.4, Vector3::UnitX()).toRotationMatrix());
  const TriangleMesh turned_peg =
      ChamferedPeg(8, 50, 0.5, 48)
          .Transformed(Eigen::AngleAxisd(0.4, Vector3::UnitX()).toRotationMatrix());
  const ImportedPart plate = NamedPart("plate", drilled, {0, 0, 0});
  const ImportedPart peg = NamedPart("peg", turned_peg, {0, 0, 0});
  const std::optional<MatedPair> pair = FindMating(plate, peg);
  ASSERT_TRUE(pair);
  const Document scenario = Document::Parse(ScenarioOf(*pair), "scenario.yaml");
  scenario.RequireFormat("assay-scenario/1");
  for (const char* name : {"plate", "peg"}) {
    const Value down = scenario.root().At("parts").At(name).At("pose").At("down");
    EXPECT_NEAR(std::abs(down.Numbers(3)[2]), 1, 1e-5) << name;  // both have their axis upright
  }
  const Value goal = scenario.root().At("goal").Items()[0].At("assembled");
  EXPECT_EQ(goal.At("held").Text(), "peg");
  EXPECT_NEAR(scenario.root().At("clearance").Number(), 0.1, 1e-3);
}

// The gripper for small parts takes pegs up to 30 mm wide.
TEST(MatedPair, WorkcellHasAGripperForTheHeldPart) {
  const auto workcell = [](double width) {
    const TriangleMesh drilled = Extruded(RectangleOf(100, 100), 12, {CircleOf(width + 0.2, 48)});
    const ImportedPart plate = NamedPart("plate", drilled, {0, 0, 0});
    const ImportedPart peg = NamedPart("peg", ChamferedPeg(width, 50, 0.5, 48), {0, 0, 0});
    const std::optional<MatedPair> pair = FindMating(plate, peg);
    if (!pair) return std::string();
    return Document::Parse(ScenarioOf(*pair), "scenario.yaml").root().At("workcell").Text();
  };
  EXPECT_EQ(workcell(8), "puma762-small-jaw");
  EXPECT_EQ(workcell(40), "puma762-table");
}

}  // namespace
}  // namespace assay::mesh_import
