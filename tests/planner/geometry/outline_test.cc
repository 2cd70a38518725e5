#include "planner/geometry/outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/base/random.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"

namespace assay::geometry::outline_test {
namespace {

constexpr std::uint64_t kSeed = 21;
constexpr double kTolerance = 1e-7;

// A frame of a plane in space: its third axis is the plane's normal.
Pose RandomFrame(RandomStream& random) {
  const Vector3 turn(random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(-2, 2));
  return Translation({random.Uniform(), random.Uniform(), random.Uniform()}) *
         Eigen::AngleAxisd(turn.norm(), turn.normalized());
}

Outline InSpace(const Polygon& polygon, const Pose& X) {
  Outline outline;
  for (const Vector2& p : polygon) outline.push_back(X * Vector3(p.x(), p.y(), 0));
  return outline;
}

Polygon InPlane(const Outline& outline, const Pose& X) {
  Polygon polygon;
  for (const Vector3& p : outline) polygon.push_back((X.inverse() * p).head<2>());
  return polygon;
}

Polygon RandomPolygon(RandomStream& random) {
  std::vector<Vector2> points;
  for (int i = 4 + random.Index(6); i > 0; --i) {
    points.emplace_back(random.Uniform(-1, 1), random.Uniform(-1, 1));
  }
  return Hull2(points);
}

// Returns a plane across the plane of the frame, through a point near the frame's origin.
Plane RandomCut(const Pose& X, RandomStream& random) {
  const double angle = random.Uniform(0, 2 * std::numbers::pi);
  const Vector3 normal = X.linear() * Vector3(std::cos(angle), std::sin(angle), 0);
  return {normal, normal.dot(X.translation()) + random.Uniform(-0.3, 0.3)};
}

TEST(Outline, HalvesAreOnTheirSidesAndHaveTheWholeArea) {
  RandomStream random(kSeed, "halves");
  for (int trial = 0; trial < 500; ++trial) {
    const Pose X = RandomFrame(random);
    const Outline whole = InSpace(RandomPolygon(random), X);
    const Plane cut = RandomCut(X, random);
    const auto [above, below] = Split(whole, cut, kTolerance);
    for (const Vector3& p : above) EXPECT_GE(cut.Above(p), -kTolerance);
    for (const Vector3& p : below) EXPECT_LE(cut.Above(p), kTolerance);
    EXPECT_NEAR(Area(InPlane(above, X)) + Area(InPlane(below, X)), Area(InPlane(whole, X)), 1e-6);
  }
}

TEST(Outline, HalvesMergeIntoTheWhole) {
  RandomStream random(kSeed, "merged");
  for (int trial = 0; trial < 500; ++trial) {
    const Pose X = RandomFrame(random);
    const Outline whole = InSpace(RandomPolygon(random), X);
    const auto [above, below] = Split(whole, RandomCut(X, random), kTolerance);
    if (!IsBroad(above, 1e-3) || !IsBroad(below, 1e-3)) continue;
    EXPECT_EQ(ConnectedParts({above, below}, kTolerance).size(), 1U);
    const std::vector<Outline> merged = Merged({above, below}, X.linear().col(2), kTolerance);
    ASSERT_EQ(merged.size(), 1U) << "trial " << trial;
    EXPECT_NEAR(Area(InPlane(merged.front(), X)), Area(InPlane(whole, X)), 1e-6);
  }
}

TEST(Outline, SquaresThatMeetInACornerAreApart) {
  const Polygon square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const Pose X = Pose::Identity();
  const Outline first = InSpace(square, X);
  const Outline at_corner = InSpace(square, Translation({1, 1, 0}));
  const Outline at_side = InSpace(square, Translation({1, 0.5, 0}));
  EXPECT_EQ(ConnectedParts({first, at_corner}, kTolerance).size(), 2U);
  EXPECT_EQ(ConnectedParts({first, at_side}, kTolerance).size(), 1U);
  EXPECT_EQ(ConnectedParts({first, at_corner, at_side}, kTolerance).size(), 1U);
  EXPECT_EQ(Merged({first, at_side}, Vector3::UnitZ(), kTolerance).size(), 2U);
}

TEST(Outline, DistanceOutsideASquare) {
  const Outline square = InSpace({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, Pose::Identity());
  EXPECT_DOUBLE_EQ(DistanceOutside(square, Vector3::UnitZ(), {1, 0.5, 0}), -0.5);
  EXPECT_DOUBLE_EQ(DistanceOutside(square, Vector3::UnitZ(), {2, 1, 0}), 0);
  EXPECT_DOUBLE_EQ(DistanceOutside(square, Vector3::UnitZ(), {5, 1, 0}), 3);
}

TEST(Outline, ASliverIsNotBroad) {
  EXPECT_TRUE(IsBroad(InSpace({{0, 0}, {1, 0}, {1, 1}}, Pose::Identity()), 1e-3));
  EXPECT_FALSE(IsBroad(InSpace({{0, 0}, {1, 0}, {1, 1e-4}}, Pose::Identity()), 1e-3));
  EXPECT_FALSE(IsBroad(InSpace({{0, 0}, {1, 0}}, Pose::Identity()), 1e-3));
}

}  // namespace
}  // namespace assay::geometry::outline_test
