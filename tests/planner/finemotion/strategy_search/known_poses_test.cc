#include "planner/finemotion/strategy_search/known_poses.h"

#include <gtest/gtest.h>

namespace assay::finemotion::known_poses_test {
namespace {

const Vector3 kIn = -Vector3::UnitZ();
const ContactKey kContact{ContactKind::kVertexFace, 1, 2};

BelievedPose BelievedPoseOf(const PoseChange& at, double shift) {
  BelievedPose believed;
  believed.X_StationaryMoving = Displaced(Pose::Identity(), at);
  PoseChange errors;
  errors << Vector3::Constant(shift), Vector3::Constant(0.01);
  believed.errors = errors.asDiagonal().toDenseMatrix();
  return believed;
}

PoseChange At(double x, double z, double turn) {
  PoseChange at = PoseChange::Zero();
  at[0] = x;
  at[2] = z;
  at[4] = turn;
  return at;
}

BelievedPose Kept(BelievedPose believed) {
  believed.kept = {kContact};
  return believed;
}

class KnownPosesTest : public testing::Test {
 protected:
  KnownPosesTest() { EXPECT_TRUE(known_.Add(0, BelievedPoseOf(At(0, 0, 0), 1e-3))); }

  KnownPoses known_{kIn};
};

TEST_F(KnownPosesTest, TheSameIsKnown) {
  EXPECT_FALSE(known_.Add(0, BelievedPoseOf(At(0, 0, 0), 1e-3)));
}

TEST_F(KnownPosesTest, SoIsOneThatKnowsLess) {
  EXPECT_FALSE(known_.Add(0, BelievedPoseOf(At(0, 0, 0), 2e-3)));
}

TEST_F(KnownPosesTest, OneThatKnowsMoreIsNot) {
  EXPECT_TRUE(known_.Add(0, BelievedPoseOf(At(0, 0, 0), 0.5e-3)));
}

TEST_F(KnownPosesTest, NorOneElsewhereOrTurned) {
  EXPECT_TRUE(known_.Add(0, BelievedPoseOf(At(2e-3, 0, 0), 1e-3)));
  EXPECT_TRUE(known_.Add(0, BelievedPoseOf(At(0, 0, 0.05), 1e-3)));
  EXPECT_TRUE(known_.Add(1, BelievedPoseOf(At(0, 0, 0), 1e-3))) << "at another critical point";
  EXPECT_TRUE(known_.Add(0, Kept(BelievedPoseOf(At(0, 0, 0), 1e-3)))) << "in contact";
}

TEST_F(KnownPosesTest, FreeOfContactThePartMayBeFartherOutButNotFartherIn) {
  EXPECT_FALSE(known_.Add(0, BelievedPoseOf(At(0, 0.01, 0), 1e-3)));
  EXPECT_TRUE(known_.Add(0, BelievedPoseOf(At(0, -0.01, 0), 1e-3)));
  EXPECT_TRUE(known_.Add(0, Kept(BelievedPoseOf(At(0, 0, 0), 1e-3))));
  EXPECT_TRUE(known_.Add(0, Kept(BelievedPoseOf(At(0, 0.01, 0), 1e-3))));
}

}  // namespace
}  // namespace assay::finemotion::known_poses_test
