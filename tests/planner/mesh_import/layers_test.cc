#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/mesh_import/parts/mated_pair.h"
#include "planner/mesh_import/parts/part_import.h"
#include "planner/mesh_import/repair/mesh_repair.h"
#include "planner/mesh_import/sections/common_axis.h"
#include "planner/mesh_import/sections/narrows.h"
#include "planner/mesh_import/sections/stepped_columns.h"
#include "tests/planner/mesh_import/made_mesh.h"
#include "tests/planner/mesh_import/scenario_of.h"

// Shafts and holes that are one layer of several.
namespace assay::mesh_import {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kSides = 48;

ImportedPart MovedPart(const std::string& name, TriangleMesh mesh,
                       const Vector3& offset = Vector3::Zero()) {
  for (Vector3& vertex : mesh.vertices) vertex += offset;
  return Import({Written(name + ".obj", ObjText(mesh))}, name, {});
}

std::vector<std::string> FeaturesOfKind(const ImportedPart& part, SketchFeature::Kind kind) {
  std::vector<std::string> texts;
  for (const SketchFeature& feature : part.sketch.features) {
    if (feature.kind == kind) texts.push_back(feature.what);
  }
  return texts;
}

// From below: a thin end, a wide layer, a groove, and a layer as wide as the other one.
TriangleMesh GroovedPin() {
  return Through({{0, CircleOf(3, kSides)},
                  {8, CircleOf(3, kSides)},
                  {8, CircleOf(5, kSides)},
                  {14, CircleOf(5, kSides)},
                  {14, CircleOf(4, kSides)},
                  {16, CircleOf(4, kSides)},
                  {16, CircleOf(5, kSides)},
                  {30, CircleOf(5, kSides)}},
                 {});
}

TriangleMesh CounterboredBlock() {
  const Curve block = RectangleOf(40, 30);
  return Through({{0, block}, {20, block}}, {{{0, CircleOf(3.2, kSides)},
                                              {10, CircleOf(3.2, kSides)},
                                              {10, CircleOf(5.3, kSides)},
                                              {20, CircleOf(5.3, kSides)}}});
}

TEST(Layers, LayersThatCanGoFirstAreShafts) {
  EXPECT_THAT(FeaturesOfKind(MovedPart("pin", GroovedPin()), SketchFeature::Kind::kShaft),
              ElementsAre("round shaft, 6 mm, 8 mm long, tip toward -z",
                          "round shaft, 10 mm, 6 mm long, tip toward +z",
                          "round shaft, 10 mm, 6 mm long, tip toward -z",
                          "round shaft, 10 mm, 14 mm long, tip toward +z",
                          "round shaft, 10 mm, 14 mm long, tip toward -z"));
}

TEST(Layers, ANarrowHoleOpensIntoAWiderOne) {
  EXPECT_THAT(
      FeaturesOfKind(MovedPart("block", CounterboredBlock()), SketchFeature::Kind::kHole),
      ElementsAre("round hole, 10.6 mm, 10 mm deep", "round hole, 6.4 mm, through, mouth toward +z",
                  "round hole, 6.4 mm, through, mouth toward -z"));
}

// The layer behind the groove has just come to the mouth, and the layer before it implies nothing
// about the thin end, which is farther in the wide hole.
TEST(Layers, AMatingNamesTheLayersThatMeet) {
  const ImportedPart pin = MovedPart("pin", GroovedPin(), {0, 0, 4});
  const ImportedPart block = MovedPart("block", CounterboredBlock());
  const std::optional<MatedPair> pair = FindMating(block, pin);
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->held, &pin);
  ASSERT_EQ(pair->features.size(), 3u);
  const double gaps[] = {0.2e-3, 0.3e-3, 2.3e-3};
  const double depths[] = {6e-3, 8e-3, 16e-3};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(pair->features[i].LeastGap(), gaps[i], 1e-7) << i;
    EXPECT_NEAR(pair->features[i].depth, depths[i], 1e-7) << i;
  }
  EXPECT_NEAR(pair->reach, 16e-3, 1e-7);
  EXPECT_THAT(ScenarioOf(*pair), HasSubstr("mating_vector: [0, 0, -36]"));
}

// The second layer of a grooved pin follows the first one through the same hole.
TEST(Layers, AnEquallyWideLayerThatFollowsIsNotNamed) {
  const ImportedPart plate =
      MovedPart("plate", Extruded(RectangleOf(40, 30), 12, {CircleOf(5.2, kSides)}), {0, 0, 0});
  const ImportedPart pin = MovedPart("pin", GroovedPin(), {0, 0, -6});
  const std::optional<MatedPair> pair = FindMating(plate, pin);
  ASSERT_TRUE(pair);
  ASSERT_EQ(pair->features.size(), 2u);
  EXPECT_NEAR(pair->features[0].depth, 10e-3, 1e-7) << "the wide layer";
  EXPECT_NEAR(pair->features[1].depth, 18e-3, 1e-7) << "the thin end";
}

// A thin end that has gone through the whole hole is named, too, since it has to pass the hole. It
// alone would be no mating.
TEST(Layers, AnEndThatHasPassedTheHoleIsNamed) {
  const ImportedPart plate =
      MovedPart("plate", Extruded(RectangleOf(40, 30), 5, {CircleOf(5.2, kSides)}), {0, 0, 9});
  const auto features = [&](double low) {
    const std::optional<MatedPair> pair =
        FindMating(plate, MovedPart("pin", GroovedPin(), {0, 0, low}));
    return pair ? pair->features.size() : 0;
  };
  EXPECT_EQ(features(0), 2u) << "8 mm of the pin are below the plate";
  EXPECT_EQ(features(-12), 1u) << "the way of the upper layer from below is shorter";
  EXPECT_EQ(features(-40), 0u) << "the pin is below the plate";
}

// A pocket around a boss is no hole, since the boss is in its mouth. A hole in the boss is one.
TEST(Layers, ABossCoversTheMouthOfThePocketAroundIt) {
  MadeMesh made;
  const Curve block = RectangleOf(40, 40);
  const Curve pocket = CircleOf(10, kSides);
  const Curve boss = CircleOf(6, kSides);
  const Curve hole = CircleOf(2, kSides);
  made.AddWall({{0, block}, {20, block}}, false);
  made.AddWall({{10, pocket}, {20, pocket}}, true);
  made.AddWall({{10, boss}, {20, boss}}, false);
  made.AddWall({{0, hole}, {20, hole}}, true);
  made.AddEnd(0, block, {hole}, false);
  made.AddEnd(10, pocket, {boss}, true);
  made.AddEnd(20, block, {pocket}, true);
  made.AddEnd(20, boss, {hole}, true);
  const ImportedPart part = MovedPart("block", made.mesh);
  EXPECT_THAT(FeaturesOfKind(part, SketchFeature::Kind::kHole),
              Not(::testing::Contains(HasSubstr("20 mm"))));
  for (const SketchPocket& cut : part.sketch.pockets) {
    const SketchSolid& solid = part.sketch.solids[static_cast<std::size_t>(cut.solid)];
    const bool is_of_block = cut.pocket.post.low >= 10e-3 - 1e-9 && solid.name == "body";
    EXPECT_FALSE(is_of_block && cut.pocket.post.at_low.radius < 5e-3) << cut.name;
  }
}

Column RoundColumn(double low, double high, double radius, bool is_hole, double off = 0) {
  Column column;
  column.is_hole = is_hole;
  column.low = low;
  column.high = high;
  column.at_low = FitContour(CircleOf(radius, kSides, {off, 0}), {.tolerance = 1e-6});
  column.at_high = column.at_low;
  return column;
}

// No point of the old outline is outside of the new one, and none of the new hole outside of the
// old one.
TEST(CommonAxis, CirclesMoveOnTheSafeSide) {
  std::vector<Column> columns = {
      RoundColumn(0, 1, 5, false, 0.002), RoundColumn(1, 4, 6, false, 0.0),
      RoundColumn(0, 4, 2, true, 0.003), RoundColumn(0, 1, 5, false, 3.0)};
  const std::vector<Column> before = columns;
  GiveCommonAxes(columns, 0.01);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LT((columns[i].at_low.center - columns[1].at_low.center).norm(), 1e-9) << i;
  for (const Vector2& p : before[0].at_low.Outline(64))
    EXPECT_LE((p - columns[0].at_low.center).norm(), columns[0].at_low.radius + 1e-9);
  for (const Vector2& p : columns[2].at_low.Outline(64))
    EXPECT_LE((p - before[2].at_low.center).norm(), before[2].at_low.radius + 1e-9);
  EXPECT_NEAR(columns[3].at_low.center.x(), 3, 1e-3) << "too far away";
}

TEST(Narrows, TheNeckOfAHoleGetsTheMaterialBeyondIt) {
  std::vector<Column> columns = {RoundColumn(0, 1, 3.2, true), RoundColumn(1, 2, 3, true),
                                 RoundColumn(2, 3, 3.2, true), RoundColumn(0, 3, 9, false)};
  for (std::size_t i = 0; i < 3; ++i) {
    columns[i].is_step = true;
    columns[i].beyond = 0.1;
  }
  FillNarrows(columns);
  EXPECT_NEAR(columns[1].at_low.radius, 2.9, 1e-6);
  EXPECT_FALSE(columns[1].is_step);
  for (const std::size_t i : {0u, 2u}) EXPECT_TRUE(columns[i].is_step) << i;
}

TEST(Narrows, ALayerBesideAWiderOneStays) {
  std::vector<Column> columns = {RoundColumn(0, 1, 3, false), RoundColumn(1, 2, 4, false),
                                 RoundColumn(2, 3, 3.5, false)};
  for (Column& column : columns) {
    column.is_step = true;
    column.beyond = 0.1;
  }
  FillNarrows(columns);
  EXPECT_TRUE(columns[0].is_step);
  EXPECT_NEAR(columns[1].at_low.radius, 4.1, 1e-6);
  EXPECT_TRUE(columns[2].is_step);
}

// A square bar that bulges by 0.04 mm is as wide as its middle, and a hole like it as narrow as its
// ends.
TEST(SteppedColumns, NearlyEvenSectionsKeepAllMaterial) {
  const auto bulging = [](double width) {
    return MadeWall{{0, RectangleOf(width, width)},
                    {10, RectangleOf(width + 0.04, width + 0.04)},
                    {20, RectangleOf(width, width)}};
  };
  const RepairedMesh mesh = Repair(Through(bulging(16), {bulging(6)}));
  const Columns columns = SteppedColumnsOf(
      mesh.bodies.at(0), {.tolerance = 2e-3, .most_left_out = 0, .most_step = 0.16});
  ASSERT_EQ(columns.columns.size(), 2u) << columns.reason;
  for (const Column& column : columns.columns) {
    EXPECT_FALSE(column.is_step);
    EXPECT_NEAR(column.high - column.low, 20, 1e-9);
    EXPECT_NEAR(column.at_low.Bounds().sizes().x(), column.is_hole ? 6 : 16.04, 2e-3);
  }
}

}  // namespace
}  // namespace assay::mesh_import
