#include "planner/geometry/solids/shadow.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "tests/oracle/box_pair.h"
#include "tests/oracle/random_pose.h"

namespace assay::geometry::shadow_test {
namespace {

constexpr std::uint64_t kSeed = 8;

TEST(ShadowTest, AnAlignedBoxCastsItsRectangleWhereverItIsCut) {
  const Box box = Box::FromCorners({1, 2, 3}, {2, 4, 6});
  for (const auto& [low, high] : {std::pair(3.5, 3.5), std::pair(0.0, 9.0), std::pair(5.0, 7.0)}) {
    EXPECT_NEAR(Area(ShadowBetween(HullOf(box), low, high)), 2, 1e-12);
  }
  EXPECT_LT(ShadowBetween(HullOf(box), 6.1, 7).size(), 3u);
  EXPECT_LT(ShadowBetween(HullOf(box), -1, 2.9).size(), 3u);
}

TEST(ShadowTest, ACubeOnItsEdgeCastsAWedgesShadow) {
  const Box cube{RotationX(std::atan(1)), Vector3(1, 1, 1)};
  EXPECT_NEAR(Area(ShadowBetween(HullOf(cube), 0, 0)), 2 * 2 * std::sqrt(2), 1e-12);
  EXPECT_NEAR(Area(ShadowBetween(HullOf(cube), 1, 2)), 2 * 2 * (std::sqrt(2) - 1), 1e-12);
}

// Every point of the box between the planes falls into the shadow. Over every corner of the shadow
// there is a point of the box between the planes.
TEST(ShadowTest, IsTheProjectionOfTheCutBox) {
  RandomStream random(kSeed, "shadow");
  for (int trial = 0; trial < 200; ++trial) {
    const Box box{oracle::RandomPose(random, 0.5),
                  Vector3(random.Uniform(0.2, 1), random.Uniform(0.2, 1), random.Uniform(0.2, 1))};
    const double low = random.Uniform(-1, 1);
    const double high = low + random.Uniform(0, 0.5);
    const Polygon shadow = ShadowBetween(HullOf(box), low, high);
    for (int i = 0; i < 200; ++i) {
      const Vector3 p =
          box.X_FrameBox * box.half_extents.cwiseProduct(oracle::RandomVector(random, 1));
      if (p.z() < low || p.z() > high) continue;
      EXPECT_GT(Depth(shadow, p.head<2>()), -1e-9) << "seed " << kSeed;
    }
    std::vector<double> heights = {low, high};
    for (const Vector3& corner : box.Corners()) {
      heights.push_back(std::clamp(corner.z(), low, high));
    }
    for (const Vector2& p : shadow) {
      EXPECT_TRUE(std::ranges::any_of(
          heights, [&](double z) { return oracle::IsWithin(box, Vector3(p.x(), p.y(), z), 1e-9); }))
          << "seed " << kSeed << " trial " << trial;
    }
  }
}

}  // namespace
}  // namespace assay::geometry::shadow_test
