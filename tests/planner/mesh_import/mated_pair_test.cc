#include "planner/mesh_import/parts/mated_pair.h"
#include "planner/mesh_import/parts/mated_scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/input_files/document.h"
#include "planner/mesh_import/parts/part_import.h"
#include "planner/mesh_import/parts/resting_pose.h"
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
    EXPECT_THAT(ScenarioText(*pair),
                HasSubstr(side > 0 ? "mating_vector: [0, 0, -30]" : "mating_vector: [0, 0, 30]"));
  }
}

// A part that can stand as it is mated starts so. The hand can then keep it as it takes it.
TEST(MatedPair, APartStartsWithItsTipDown) {
  const ImportedPart plate =
      NamedPart("plate", Extruded(RectangleOf(40, 40), 12, {CircleOf(8.1, 48)}), {0, 0, 0});
  const ImportedPart peg = NamedPart("peg", ChamferedPeg(8, 50, 0.5, 48), {0, 0, 2});
  EXPECT_THAT(ScenarioText(*FindMating(plate, peg)),
              HasSubstr("model: peg\n    pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], "));
  const ImportedPart below = NamedPart("peg", ChamferedPeg(8, 50, 0.5, 48), {0, 0, -40});
  EXPECT_THAT(ScenarioText(*FindMating(plate, below)), HasSubstr("[0, 0, -1], [500, -200, "));
}

TEST(MatedPair, TheHeldPartIsMovedToItsSeat) {
  const ImportedPart plate =
      NamedPart("plate", Extruded(RectangleOf(40, 40), 12, {CircleOf(8.1, 48)}), {0, 0, 0});
  const ImportedPart peg = NamedPart("peg", ChamferedPeg(8, 50, 0.5, 48), {0, 0, 0.2});
  MatedPair pair = FindMating(plate, peg).value();
  EXPECT_EQ(AccountOf(pair).size(), 1u);
  pair.way_to_seat = 0.2e-3;
  EXPECT_THAT(ScenarioText(pair), HasSubstr("[0, 0, 1], [0, 0, -0.2]]}\n"
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
  const Document scenario = Document::Parse(ScenarioText(*pair), "scenario.yaml");
  scenario.RequireFormat("assay-scenario/1");
  for (const char* name : {"plate", "peg"}) {
    const auto columns = scenario.root().At("parts").At(name).At("pose").At("columns").Items();
    ASSERT_EQ(columns.size(), 4u);
    Matrix3 R;
    for (int i = 0; i < 3; ++i) R.col(i) = Vector3(columns[i].Numbers(3).data());
    EXPECT_NEAR(R.determinant(), 1, 1e-5);
    EXPECT_NEAR(std::abs(R(2, 2)), 1, 1e-5) << name;  // both have their axis upright
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
    return Document::Parse(ScenarioText(*pair), "scenario.yaml").root().At("workcell").Text();
  };
  EXPECT_EQ(workcell(8), "puma762-small-jaw");
  EXPECT_EQ(workcell(40), "puma762-table");
}

// A round rod stands on its ends. It does not rest on its side, on which it rolls.
TEST(RestingPose, ARoundRodStandsOnItsEndsAlone) {
  const std::vector<RestingPose> rod =
      RestingPosesOf(NamedPart("rod", Extruded(CircleOf(10, 48), 20), {0, 0, 0}));
  ASSERT_EQ(rod.size(), 2u);
  for (const RestingPose& pose : rod) EXPECT_NEAR(std::abs(pose.down.z()), 1, 1e-6);
}

// A cube is equally stable on each of its faces. A long bar is most stable on its widest side.
TEST(RestingPose, TiltsAreThoseOfTheGeometry) {
  const std::vector<RestingPose> cube =
      RestingPosesOf(NamedPart("cube", Extruded(RectangleOf(20, 20), 20), {0, 0, 0}));
  ASSERT_EQ(cube.size(), 6u);
  for (const RestingPose& pose : cube) EXPECT_NEAR(pose.tilt, std::numbers::pi / 4, 1e-9);
  const ImportedPart bar = NamedPart("bar", Extruded(RectangleOf(20, 10), 60), {5, 0, 0});
  const std::vector<RestingPose> poses = RestingPosesOf(bar);
  ASSERT_EQ(poses.size(), 6u);
  EXPECT_NEAR(poses.front().tilt, std::atan2(10, 5), 1e-9);
  EXPECT_NEAR(std::abs(poses.front().down.y()), 1, 1e-9);
  const geometry::Pose X_WorldPart = OnTable(bar, poses.front().down, {0.6, 0.1});
  EXPECT_NEAR((X_WorldPart * Vector3(5e-3, 0, 30e-3) - Vector3(0.6, 0.1, 5e-3)).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace assay::mesh_import
