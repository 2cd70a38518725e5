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

TEST(PadContact, IsWhollyOnAPlainFace) {
  for (const PadContact& pad : FrontToBack(5.5))
    EXPECT_EQ(PointsOffSurface(pad, Block().pieces()), 0);
}

TEST(PadContact, OverTheHoleIsOffTheSurfaceAndCoversIt) {
  const auto [front, back] = FrontToBack(3.25);
  EXPECT_EQ(PointsOffSurface(front, Block().pieces()), static_cast<int>(front.points.size()));
  EXPECT_EQ(PointsOffSurface(back, Block().pieces()), 0);
  EXPECT_TRUE(Covers(front, Block(), FeatureOf(Block(), 7)));
  EXPECT_FALSE(Covers(back, Block(), FeatureOf(Block(), 7)));
  EXPECT_FALSE(Covers(front, Block(), FeatureOf(Block(), 8)));
}

TEST(PadContact, CoversAHoleThatIsSmallerThanThePad) {
  const auto [front, back] = FrontToBack(4.375);
  EXPECT_GT(PointsOffSurface(front, Block().pieces()), 0);
  EXPECT_TRUE(Covers(front, Block(), FeatureOf(Block(), 8)));
}

TEST(PadContact, OfTheWrongWidthIsOffTheSurface) {
  for (const double width : {0.0761, 0.0763}) {
    Hold hold = BlockHold();
    hold.width = width;
    for (const PadContact& pad : PadContactsOf(hold, Vector2(0.008, 0.008))) {
      EXPECT_EQ(PointsOffSurface(pad, Block().pieces()), static_cast<int>(pad.points.size()));
    }
  }
}

TEST(PadContact, OverAnEdgeIsPartlyOffTheSurface) {
  const auto [front, back] = FrontToBack(6.5);
  EXPECT_GT(PointsOffSurface(back, Block().pieces()), 100);
  EXPECT_LT(PointsOffSurface(back, Block().pieces()), static_cast<int>(back.points.size()));
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
