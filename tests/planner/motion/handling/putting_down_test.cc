#include "planner/motion/handling/putting_down.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/base/random.h"
#include "planner/domain/resting/resting.h"
#include "planner/geometry/pose.h"
#include "tests/planner/motion/handling/cans.h"

namespace assay::motion::putting_down_test {
namespace {

using testing::IsEmpty;

double Lowest(const domain::Part& part, const Pose& X_WorldPart) {
  double lowest = 1e9;
  for (const Vector3& vertex : part.model->corners()) {
    lowest = std::min(lowest, (X_WorldPart * vertex).z());
  }
  return lowest;
}

Pose RandomPose(RandomStream& random) {
  return geometry::Translation(random.Uniform(-1, 1), random.Uniform(-1, 1),
                               random.Uniform(-1, 1)) *
         geometry::RotationZ(random.Uniform(-3, 3)) *
         Pose(Eigen::AngleAxisd(random.Uniform(-1, 1), Vector3::UnitX()));
}

TEST(StraightBelow, OnlyLowersThePartToTheTable) {
  RandomStream random(1, "straight below");
  for (int i = 0; i < 20; ++i) {
    const domain::Part& part = Cans().part(PartId(i % 3));
    const Pose before = RandomPose(random);
    const Pose after = StraightBelow(part, before);
    EXPECT_NEAR(Lowest(part, after), 0, 1e-12);
    EXPECT_TRUE(after.linear() == before.linear());
    EXPECT_TRUE(after.translation().head<2>() == before.translation().head<2>());
  }
}

// A naive test: the footprints' vertices and edges are farther apart than the room.
TEST(FreePosesOn, HaveRoomOverTheTableAndTheNearestToTheMiddleComeFirst) {
  Surroundings around = CanInTheHand();
  around.parts.front().X_WorldPart.translation() << 0.5, 0.3, 0;
  const domain::Part& can = Cans().part(kCan);
  const Pose below = StraightBelow(can, geometry::RotationZ(0.3));
  const std::vector<Pose> poses = FreePosesOn(SecondTable(), Cans(), around, below);
  ASSERT_GT(poses.size(), 100u);
  double before = 0;
  for (const Pose& X_WorldPart : poses) {
    EXPECT_NEAR(Lowest(can, X_WorldPart), 0, 1e-12);
    EXPECT_TRUE(domain::IsOver(SecondTable(), can, X_WorldPart));
    const Vector3 apart = X_WorldPart.translation() - Vector3(0.5, 0.3, 0);
    EXPECT_GT(apart.norm(), 0.06 + 2 * 0.03 * std::cos(M_PI / 8));  // radii of the octagons within
    const double from_middle = (X_WorldPart.translation() - Vector3(0.6, 0.4, 0)).norm();
    EXPECT_GE(from_middle, before - 1e-9);
    before = from_middle;
  }
}

TEST(FreePosesOn, AreNoneWhereAPartFillsTheTable) {
  Surroundings around = CanInTheHand();
  const Pose below = StraightBelow(Cans().part(kCan), Pose::Identity());
  const domain::Table narrow{.name = "narrow",
                             .top = {{0.55, 0.35}, {0.65, 0.35}, {0.65, 0.45}, {0.55, 0.45}}};
  EXPECT_EQ(FreePosesOn(narrow, Cans(), around, below).size(), 8u);
  around.parts.front().X_WorldPart.translation() << 0.6, 0.4, 0;
  EXPECT_THAT(FreePosesOn(narrow, Cans(), around, below), IsEmpty());
}

class FreePoseInAPlace : public testing::Test {
 protected:
  // Returns the position at which FreePoseIn puts the part down.
  std::optional<Vector3> Spot() const {
    const Pose below = StraightBelow(Cans().part(kCan), Pose::Identity());
    const auto pose = FreePoseIn(place_, Cans(), around_, below);
    return pose ? std::optional<Vector3>(pose->translation()) : std::nullopt;
  }

  domain::Place place_ = {.name = "place", .middle = {.x = 0.6, .y = 0.35}, .radius = 0.15};
  Surroundings around_ = CanInTheHand();
};

TEST_F(FreePoseInAPlace, IsAtTheMiddleIfThatIsFree) {
  ASSERT_TRUE(Spot());
  EXPECT_TRUE(Spot()->isApprox(Vector3(0.6, 0.35, 0), 1e-9));
}

TEST_F(FreePoseInAPlace, IsBesideAPartInTheMiddle) {
  around_.parts.front().X_WorldPart.translation() << 0.6, 0.35, 0;
  ASSERT_TRUE(Spot());
  EXPECT_NEAR((*Spot() - Vector3(0.6, 0.35, 0)).norm(), 0.1, 1e-9);
}

TEST_F(FreePoseInAPlace, IsNoneIfAPartIsInTheMiddleOfASmallPlace) {
  place_.radius = 0.05;
  around_.parts.front().X_WorldPart.translation() << 0.6, 0.35, 0;
  EXPECT_FALSE(Spot());
}

TEST_F(FreePoseInAPlace, IsNoneWhereTheArmDoesNotReach) {
  place_.middle.x = 3;
  EXPECT_FALSE(Spot());
}

}  // namespace
}  // namespace assay::motion::putting_down_test
