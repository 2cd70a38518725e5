#include "planner/plan/checker/resting_balance.h"

#include <gtest/gtest.h>

#include <array>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/oracle/random_pose.h"

namespace assay::plan::resting_balance_test {
namespace {

using geometry::Box;
using geometry::Vector2;
using geometry::Vector3;

constexpr std::uint64_t kSeed = 3;

TEST(CenterOfMass, OfAnL) {
  const std::array<Box, 2> boxes = {Box::FromCorners({0, 0, 0}, {1, 1, 2}),
                                    Box::FromCorners({1, 0, 0}, {3, 1, 1})};
  EXPECT_LT((CenterOfMass(geometry::HullsOf(boxes)) - Vector3(1.25, 0.5, 0.75)).norm(), 1e-12);
}

TEST(CenterOfMass, CountsOverlapsOnce) {
  const std::array<Box, 2> boxes = {Box::FromCorners({0, 0, 0}, {2, 1, 1}),
                                    Box::FromCorners({1, 0, 0}, {4, 1, 1})};
  EXPECT_LT((CenterOfMass(geometry::HullsOf(boxes)) - Vector3(2, 0.5, 0.5)).norm(), 1e-12);
}

TEST(CenterOfMass, OfATurnedPrismIsNearItsAxis) {
  const Box bar{geometry::Translation(1, 2, 3), {0.5, 0.1, 0.1}};
  const std::array<Box, 2> octagon = {
      bar, Box{bar.X_FrameBox * geometry::RotationX(M_PI / 4), bar.half_extents}};
  EXPECT_LT((CenterOfMass(geometry::HullsOf(octagon)) - Vector3(1, 2, 3)).norm(), 0.002);
}

TEST(CenterOfMass, AgreesWithMassOfForRandomAlignedBoxes) {
  RandomStream random(kSeed, "boxes");
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<Box> boxes;
    for (int i = 0; i < 4; ++i) {
      const Vector3 low = oracle::RandomVector(random, 1);
      boxes.push_back(Box::FromCorners(low, low + Vector3(random.Uniform(0.1, 1), 0.5, 0.4)));
    }
    EXPECT_LT((CenterOfMass(geometry::HullsOf(boxes)) -
               geometry::MassOf(geometry::HullsOf(boxes), 1).center)
                  .norm(),
              1e-9)
        << "seed " << kSeed << " trial " << trial;
  }
}

// A lying cylinder touches the table along the lowest line of its circle. A polygon with 8 sides
// stands for it.
TEST(TouchingTable, HasTheLowestLineOfALyingCylinder) {
  const double corner = std::tan(M_PI / 8);  // half of a side
  const std::vector<Vector3> corners = {
      {0, corner, 0}, {0, -corner, 0}, {3, corner, 0}, {3, -corner, 0}, {0, 1, 2}};
  const geometry::RoundSolid cylinder = {{Vector3(0, 0, 1), Vector3(3, 0, 1)}, {1, 1}, 8};
  for (const Vector3& touch : TouchingTable(corners, std::array{cylinder})) {
    EXPECT_NEAR(touch.y(), 0, 1e-12);
  }
  EXPECT_EQ(TouchingTable(corners, {}).front(), corners.front());
  EXPECT_FALSE(IsSupported({1, 0, 1}, TouchingTable(corners, std::array{cylinder})));
  EXPECT_TRUE(IsSupported({1, 0, 1}, TouchingTable(corners, {})));
}

// An upright cylinder stands on its whole end.
TEST(TouchingTable, KeepsTheCornersOfAnEnd) {
  const std::vector<Vector3> corners = {{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  const geometry::RoundSolid upright = {{Vector3(0, 0, 0), Vector3(0, 0, 3)}, {1, 1}, 4};
  EXPECT_EQ(TouchingTable(corners, std::array{upright}), corners);
}

TEST(IsSupported, AgreesWithTheConvexHull) {
  RandomStream random(kSeed, "support");
  int supported = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<Vector3> points;
    std::vector<Vector2> flat;
    for (int i = 0; i < 3 + random.Index(5); ++i) {
      points.push_back(oracle::RandomVector(random, 1));
      flat.push_back(points.back().head<2>());
    }
    const Vector3 p = oracle::RandomVector(random, 1);
    const double depth = geometry::Depth(geometry::Hull2(flat), p.head<2>());
    if (std::abs(depth) < 1e-6) continue;
    EXPECT_EQ(IsSupported(p, points), depth > 0) << "seed " << kSeed << " trial " << trial;
    supported += depth > 0 ? 1 : 0;
  }
  EXPECT_GT(supported, 100);
}

TEST(IsSupported, NotByFewerThanThreePointsNorOnTheRim) {
  const std::vector<Vector3> edge = {{-1, 0, 0}, {1, 0, 0}};
  EXPECT_FALSE(IsSupported(Vector3::Zero(), edge));
  const std::vector<Vector3> triangle = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_FALSE(IsSupported(Vector3::Zero(), triangle));
  EXPECT_TRUE(IsSupported(Vector3(0, 0.1, 5), triangle));
}

TEST(FirstOutside, NamesThePointThatIsNotOverThePolygon) {
  const geometry::Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<Vector3> points = {{0, 0, 3}, {1, 0.5, 3}, {1.01, 0.5, 3}};
  EXPECT_EQ(FirstOutside(points, square), &points[2]);
  EXPECT_EQ(FirstOutside(std::span(points).first(2), square), nullptr);
}

}  // namespace
}  // namespace assay::plan::resting_balance_test
