#include "planner/geometry/solids/separation.h"

#include <gtest/gtest.h>

#include <array>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "tests/oracle/box_pair.h"
#include "tests/oracle/random_pose.h"

namespace assay::geometry::separation_test {
namespace {

constexpr std::uint64_t kSeed = 11;
constexpr int kPairs = 2000;

double Separation(const Box& a, const Box& b) { return geometry::Separation(HullOf(a), HullOf(b)); }

Box RandomBox(RandomStream& random) { return oracle::RandomBox(random, 1.0, 0.1, 0.8); }

TEST(Separation, KnownAnswers) {
  const Box cube = Box::FromCorners(Vector3::Zero(), Vector3::Ones());
  EXPECT_NEAR(Separation(cube, cube.Transformed(Translation(3, 0, 0))), 2, 1e-15);
  EXPECT_NEAR(Separation(cube, cube.Transformed(Translation(1, 0.5, 0))), 0, 1e-15);
  EXPECT_NEAR(Separation(cube, cube.Transformed(Translation(0.9, 0.5, 0))), -0.1, 1e-15);
  EXPECT_NEAR(Separation(cube, cube), -1, 1e-15);
}

TEST(Separation, OfCrossedEdgesIsAlongTheirCommonNormal) {
  const Box bar{Pose::Identity(), {1, 0.1, 0.1}};
  const Box along_x = bar.Transformed(RotationX(M_PI / 4));
  const Box along_y = bar.Transformed(RotationZ(M_PI / 2) * RotationX(M_PI / 4));
  const double edge_height = 0.1 * std::sqrt(2);
  EXPECT_NEAR(Separation(along_x, along_y.Transformed(Translation(0, 0, 0.5))),
              0.5 - 2 * edge_height, 1e-12);
}

TEST(Separation, AgreesWithProjectedCorners) {
  RandomStream random(kSeed, "separation");
  for (int i = 0; i < kPairs; ++i) {
    const Box a = RandomBox(random), b = RandomBox(random);
    EXPECT_NEAR(Separation(a, b), oracle::Separation(a, b), 1e-12) << "seed " << kSeed;
    EXPECT_NEAR(Separation(a, b), Separation(b, a), 1e-12);
  }
}

TEST(Separation, IsPositiveOnlyForBoxesApartAndNeverMoreThanTheirDistance) {
  RandomStream random(kSeed, "distance");
  int apart = 0;
  for (int i = 0; i < kPairs; ++i) {
    const Box a = RandomBox(random), b = RandomBox(random);
    const double gap = Separation(a, b);
    if (gap > 0) {
      ++apart;
      EXPECT_LE(gap, oracle::DisjointDistance(a, b) + 1e-12) << "seed " << kSeed;
    }
    const Vector3 in_b =
        b.X_FrameBox * oracle::RandomVector(random, 1).cwiseProduct(b.half_extents);
    EXPECT_TRUE(gap <= 0 || !oracle::IsWithin(a, in_b, 0)) << "seed " << kSeed;
  }
  EXPECT_GT(apart, kPairs / 10);
}

TEST(OverlapDepth, IsTheDeepestOfAnyPairAndZeroApart) {
  const Box cube = Box::FromCorners(Vector3::Zero(), Vector3::Ones());
  const std::array<Box, 2> pair = {cube, cube.Transformed(Translation(5, 0, 0))};
  const std::array<Box, 1> near_second = {cube.Transformed(Translation(5.7, 0, 0))};
  const std::array<Box, 1> between = {cube.Transformed(Translation(2.5, 0, 0))};
  EXPECT_NEAR(OverlapDepth(HullsOf(pair), HullsOf(near_second)), 0.3, 1e-15);
  EXPECT_EQ(OverlapDepth(HullsOf(pair), HullsOf(between)), 0);
}

}  // namespace
}  // namespace assay::geometry::separation_test
