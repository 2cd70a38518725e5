#include "planner/plan/checker/pad_contact.h"

#include <gtest/gtest.h>

#include "planner/domain/parts/part_file.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "tests/planner/plan/peg_and_block.h"

namespace assay::plan::pad_contact_test {
namespace {

using geometry::Vector2;

const domain::PartModel& Block() {
  static const auto model =
      domain::PartFile::Load(ASSAY_SOURCE_DIR "/models/parts/block/part.yaml", 0.0005);
  return *model;
}

const domain::Feature& FeatureOf(const domain::PartModel& model, int number) {
  return *model.FindFeature(domain::FeatureNumber(number));
}

// Returns the contacts of pads that close from front to back at height z of the upright block, in
// inches.
std::array<PadContact, 2> FrontToBack(double z) {
  const Hold hold = HoldWith(
      "",
      {.p = {1.5, 0, z}, .approach = -Vector3::UnitZ(), .closing = Vector3::UnitX(), .width = 3});
  return PadContactsOf(hold, Vector2(0.008, 0.008));
}

TEST(PadContact, LeftIsOnTheSideOfTheClosingDirection) {
  const auto [left, right] = FrontToBack(5.5);
  EXPECT_LT((left.normal - Vector3::UnitX()).norm(), 1e-12);
  EXPECT_LT((right.normal + Vector3::UnitX()).norm(), 1e-12);
  for (const Vector3& p : left.points) EXPECT_NEAR(p.x(), 3 * kInch, 1e-12);
  for (const Vector3& p : right.points) EXPECT_NEAR(p.x(), 0, 1e-12);
}

TEST(PadContact, TouchesAPlainFaceEverywhere) {
  EXPECT_GE(PointsOfTouch(FrontToBack(5.5), Block().pieces()), 17 * 17);
}

TEST(PadContact, OverTheHoleTouchesNothingAndCoversIt) {
  const auto pads = FrontToBack(3.25);
  EXPECT_EQ(PointsOfTouch(pads, Block().pieces()), 0);
  EXPECT_TRUE(Covers(pads[0], Block(), FeatureOf(Block(), 7)));
  EXPECT_FALSE(Covers(pads[1], Block(), FeatureOf(Block(), 7)));
  EXPECT_FALSE(Covers(pads[0], Block(), FeatureOf(Block(), 8)));
}

TEST(PadContact, CoversAHoleThatIsSmallerThanThePad) {
  const auto [front, back] = FrontToBack(4.375);
  EXPECT_TRUE(Covers(front, Block(), FeatureOf(Block(), 8)));
}

TEST(PadContact, OfTheWrongWidthTouchesNothing) {
  for (const double width : {0.0761, 0.0763}) {
    Hold hold = BlockHold();
    hold.width = width;
    EXPECT_EQ(PointsOfTouch(PadContactsOf(hold, Vector2(0.008, 0.008)), Block().pieces()), 0);
  }
}

TEST(PadContact, OverAnEdgeTouchesWithTheRest) {
  const int touched = PointsOfTouch(FrontToBack(6.5), Block().pieces());
  EXPECT_GT(touched, 100);
  EXPECT_LT(touched, 200);
}

// The middle facets of a polygon are found between the points of the grid.
TEST(PadContact, TouchesFacetsThatAreNarrowerThanTheGrid) {
  const auto cylinder = domain::PartFile::Read(
      Document::Parse("format: assay-part/1\nname: c\ninitial: C\nunits: {length: mm}\n"
                      "density: 1000\nfriction: 0.25\nsolids:\n"
                      "  c: {cylinder: {from: [0, 0, 0], to: [0, 0, 50], radius: 4, sides: 64}}\n",
                      "part.yaml"),
      0);
  Hold hold{"",
            geometry::PoseFromColumns(Vector3::UnitY(), Vector3::UnitX(), -Vector3::UnitZ(),
                                      {0, 0.0003, 0.025}),
            0.008};
  EXPECT_GE(PointsOfTouch(PadContactsOf(hold, Vector2(0.008, 0.008)), cylinder->pieces()), 3);
  hold.X_PartTool.translation().y() = 0.009;
  EXPECT_EQ(PointsOfTouch(PadContactsOf(hold, Vector2(0.008, 0.008)), cylinder->pieces()), 0);
}

TEST(IsOnTable, OnlyForWhatFacesTheTableAndTouchesIt) {
  const geometry::Pose face_down =
      geometry::Translation(0.6, 0, 3 * kInch) * geometry::RotationY(M_PI / 2);
  EXPECT_TRUE(IsOnTable(Block(), FeatureOf(Block(), 1), face_down));
  EXPECT_TRUE(IsOnTable(Block(), FeatureOf(Block(), 7), face_down));
  EXPECT_FALSE(IsOnTable(Block(), FeatureOf(Block(), 2), face_down));
  EXPECT_FALSE(IsOnTable(Block(), FeatureOf(Block(), 3), face_down));
  const geometry::Pose raised = geometry::Translation(0, 0, 0.001) * face_down;
  EXPECT_FALSE(IsOnTable(Block(), FeatureOf(Block(), 7), raised));
  EXPECT_FALSE(IsOnTable(Block(), FeatureOf(Block(), 7), BlockOnBack({}).X_WorldPart));
}

}  // namespace
}  // namespace assay::plan::pad_contact_test
