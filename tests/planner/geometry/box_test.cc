#include "planner/geometry/box.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/convex_cut.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/oracle/box_pair.h"
#include "tests/oracle/random_pose.h"

namespace assay::geometry::box_test {
namespace {

using oracle::RandomBox;
using oracle::RandomPose;
using oracle::RandomQuarterTurns;
using oracle::RandomVector;

constexpr std::uint64_t kSeed = 31;
constexpr double kPi = std::numbers::pi;

double VolumeOf(std::span<const Box> boxes) {
  double volume = 0;
  for (const Box& box : boxes) volume += oracle::VolumeOf(box);
  return volume;
}

bool AnyContains(std::span<const Box> boxes, const Vector3& p, double tolerance) {
  return std::ranges::any_of(boxes,
                             [&](const Box& box) { return oracle::IsWithin(box, p, tolerance); });
}

// Returns what a pocket that is aligned with a box leaves of it.
std::vector<Box> Subtract(const Box& minuend, const Box& pocket) {
  std::vector<Box> boxes;
  for (const ConvexHull& piece : Without(HullOf(minuend), HullOf(pocket))) {
    const std::optional<Box> box = AsBox(piece);
    EXPECT_TRUE(box.has_value());
    if (box) boxes.push_back(*box);
  }
  return boxes;
}

MassProperties MassOf(std::span<const Box> boxes, double density) {
  return geometry::MassOf(HullsOf(boxes), density);
}

Box AlignedBox(RandomStream& random, const Pose& X, double reach) {
  Box box = RandomBox(random, reach, 0.1, 1);
  box.X_FrameBox.linear() = RandomQuarterTurns(random);
  return box.Transformed(X);
}

Vector3 PointNear(RandomStream& random, const Box& box) {
  const Vector3 factors = RandomVector(random, 1.2);
  return box.X_FrameBox * factors.cwiseProduct(box.half_extents);
}

// Returns a prism with 2k sides as a union of k boxes that share an axis.
std::vector<Box> Prism(int k, double inradius, double half_height) {
  const double half_side = inradius * std::tan(kPi / (2 * k));
  std::vector<Box> boxes;
  for (int i = 0; i < k; ++i) {
    boxes.push_back({RotationZ(i * kPi / k), {inradius, half_side, half_height}});
  }
  return boxes;
}

TEST(BoxTest, CornersVolumeAndMembership) {
  const Box box = Box::FromCorners({0, 1, 2}, {2, 5, 8});
  EXPECT_DOUBLE_EQ(oracle::VolumeOf(box), 48);
  EXPECT_EQ(box.X_FrameBox.translation(), Vector3(1, 3, 5));
  for (const Vector3& corner : box.Corners()) {
    EXPECT_TRUE(oracle::IsWithin(box, corner, 1e-12));
    EXPECT_FALSE(oracle::IsWithin(box, corner, -1e-3));
  }
  EXPECT_TRUE(oracle::IsWithin(box, {2.09, 3, 5}, 0.1));
  EXPECT_FALSE(oracle::IsWithin(box, {2.11, 3, 5}, 0.1));
}

TEST(BoxTest, MembershipFollowsRigidMotions) {
  RandomStream random(kSeed, "membership");
  for (int i = 0; i < 1000; ++i) {
    const Box box = RandomBox(random, 1, 0.1, 1);
    const Pose X = RandomPose(random, 5);
    const Vector3 p = PointNear(random, box);
    EXPECT_EQ(oracle::IsWithin(box, p, 0.01), oracle::IsWithin(box.Transformed(X), X * p, 0.01));
  }
}

TEST(SubtractTest, ThroughHoleLeavesFourWallsOfFullHeight) {
  const Box block = Box::FromCorners({0, 0, 0}, {3, 4, 5});
  for (int axis = 0; axis < 3; ++axis) {
    Box pocket = Box::FromCorners({1, 1, 1}, {2, 2, 2});
    pocket.half_extents[axis] = 10;
    const std::vector<Box> walls = Subtract(block, pocket);
    ASSERT_EQ(walls.size(), 4u) << axis;
    for (const Box& wall : walls) {
      EXPECT_DOUBLE_EQ(wall.half_extents[axis], block.half_extents[axis]);
    }
  }
}

TEST(SubtractTest, BlindHoleLeavesFourWallsAndOneWholeFloorWhicheverWayItPoints) {
  const Box cube = Box::FromCorners({-2, -2, -2}, {2, 2, 2});
  for (int axis = 0; axis < 3; ++axis) {
    for (int side : {-1, 1}) {
      Vector3 center = Vector3::Zero();
      center[axis] = side * 2;
      const Box pocket{Translation(center), {1, 1, 1}};
      const std::vector<Box> ring = Subtract(cube, pocket);
      ASSERT_EQ(ring.size(), 5u);
      EXPECT_DOUBLE_EQ(oracle::VolumeOf(ring[0]), 4 * 4 * 3)
          << "the floor is cut off first, and whole";
      EXPECT_DOUBLE_EQ(VolumeOf(ring), 64 - 4);
    }
  }
}

TEST(SubtractTest, CavityLeavesSixBoxesAndACoverLeavesNone) {
  const Box cube{Pose::Identity(), {1, 1, 1}};
  EXPECT_EQ(Subtract(cube, {Pose::Identity(), {0.5, 0.5, 0.5}}).size(), 6u);
  EXPECT_TRUE(Subtract(cube, {Pose::Identity(), {1, 1, 1}}).empty());
  EXPECT_TRUE(Subtract(cube, {Pose::Identity(), {1 - 1e-10, 2, 2}}).empty()) << "slivers";
}

TEST(SubtractTest, PocketThatMissesOrTouchesReturnsTheBoxItself) {
  const Box cube{RotationX(0.3), {1, 1, 1}};
  for (double x : {2.0, 2.5}) {
    const std::vector<Box> boxes =
        Subtract(cube, Box{RotationX(0.3) * Translation(x, 0, 0), {1, 1, 1}});
    ASSERT_EQ(boxes.size(), 1u);
    EXPECT_EQ(boxes[0].half_extents, cube.half_extents);
    EXPECT_TRUE(boxes[0].X_FrameBox.isApprox(cube.X_FrameBox));
  }
}

TEST(SubtractTest, VolumesAddUpAndMembershipAgrees) {
  RandomStream random(kSeed, "subtract");
  for (int i = 0; i < 2000; ++i) {
    const Pose X = RandomPose(random, 3);
    const Box minuend = AlignedBox(random, X, 1), pocket = AlignedBox(random, X, 1);
    const std::vector<Box> boxes = Subtract(minuend, pocket);
    EXPECT_LE(boxes.size(), 6u);
    const std::array<Box, 2> both = {minuend, pocket};
    EXPECT_NEAR(VolumeOf(boxes), MassOf(both, 1).mass - oracle::VolumeOf(pocket), 1e-9)
        << "draw " << i;
    for (int k = 0; k < 50; ++k) {
      const Vector3 p = PointNear(random, minuend);
      const bool inside = oracle::IsWithin(minuend, p, -1e-7) && !oracle::IsWithin(pocket, p, 1e-7);
      const bool outside =
          !oracle::IsWithin(minuend, p, 1e-7) || oracle::IsWithin(pocket, p, -1e-7);
      const auto holders =
          std::ranges::count_if(boxes, [&](const Box& b) { return oracle::IsWithin(b, p, 0); });
      EXPECT_TRUE(!inside || AnyContains(boxes, p, 1e-8)) << "draw " << i << " seed " << kSeed;
      EXPECT_TRUE(!outside || holders == 0) << "draw " << i << " seed " << kSeed;
      EXPECT_LE(holders, 1) << "draw " << i << " seed " << kSeed;
    }
  }
}

// Returns the mass properties of a solid box in closed form.
MassProperties SolidBox(const Box& box, double density) {
  const double mass = density * oracle::VolumeOf(box);
  const Vector3 squares = box.half_extents.cwiseAbs2();
  const Vector3 own = mass / 3 * (Vector3::Constant(squares.sum()) - squares);
  const Matrix3 R = box.X_FrameBox.linear();
  return {mass, box.X_FrameBox.translation(), R * own.asDiagonal() * R.transpose()};
}

// Combines two bodies about their common centre by the parallel-axis law. A scale of -1 removes b.
MassProperties Combined(const MassProperties& a, const MassProperties& b, double scale) {
  const double mass = a.mass + scale * b.mass;
  const Vector3 center = (a.mass * a.center + scale * b.mass * b.center) / mass;
  const auto about = [&](const MassProperties& body) {
    const Vector3 d = body.center - center;
    return Matrix3(body.inertia +
                   body.mass * (d.squaredNorm() * Matrix3::Identity() - d * d.transpose()));
  };
  return {mass, center, about(a) + scale * about(b)};
}

void ExpectSame(const MassProperties& a, const MassProperties& b, double relative,
                const std::string& what) {
  EXPECT_NEAR(a.mass, b.mass, relative * b.mass) << what;
  const double size = std::sqrt(b.inertia.trace() / b.mass);
  EXPECT_LT((a.center - b.center).norm(), relative * size) << what;
  EXPECT_LT((a.inertia - b.inertia).norm(), relative * b.inertia.norm()) << what;
}

TEST(MassTest, OneBoxHasTheClosedForm) {
  RandomStream random(kSeed, "one box");
  for (int i = 0; i < 200; ++i) {
    const Box box = RandomBox(random, 1, 0.1, 1);
    ExpectSame(MassOf(std::span(&box, 1), 7), SolidBox(box, 7), 1e-12, fmt::format("draw {}", i));
  }
}

TEST(MassTest, NothingWeighsNothing) {
  EXPECT_EQ(MassOf({}, 1000).mass, 0);
  EXPECT_EQ(MassOf({}, 1000).inertia, Matrix3::Zero());
}

TEST(MassTest, OverlapsAndRepetitionsCountOnce) {
  RandomStream random(kSeed, "overlaps");
  for (int i = 0; i < 200; ++i) {
    const Pose X = RandomPose(random, 3);
    const Box a = AlignedBox(random, X, 0.5), b = AlignedBox(random, X, 0.5);
    MassProperties expected = SolidBox(a, 2);
    for (const Box& rest : Subtract(b, a)) expected = Combined(expected, SolidBox(rest, 2), 1);
    const std::array<Box, 5> boxes = {a, b, a, b, a};
    ExpectSame(MassOf(boxes, 2), expected, 1e-9, fmt::format("draw {}", i));
  }
}

TEST(MassTest, RingIsTheBlockWithoutItsHole) {
  const Box block = Box::FromCorners({0, -1.5, 0}, {3, 1.5, 6.5});
  const Box hole = Box::FromCorners({0.2, -0.75, 2.5}, {3, 0.75, 4});
  const MassProperties expected = Combined(SolidBox(block, 3), SolidBox(hole, 3), -1);
  ExpectSame(MassOf(Subtract(block, hole), 3), expected, 1e-12, "ring");
}

TEST(MassTest, FollowsRigidMotions) {
  RandomStream random(kSeed, "mass motion");
  for (int i = 0; i < 20; ++i) {
    std::vector<Box> boxes, moved;
    const Pose X = RandomPose(random, 3);
    for (int k = 0; k < 3; ++k) boxes.push_back(RandomBox(random, 0.5, 0.2, 1));
    for (const Box& box : boxes) moved.push_back(box.Transformed(X));
    MassProperties expected = MassOf(boxes, 5);
    expected.center = X * expected.center;
    expected.inertia = X.linear() * expected.inertia * X.linear().transpose();
    ExpectSame(MassOf(moved, 5), expected, 1e-9, fmt::format("draw {}", i));
  }
}

TEST(MassTest, PrismsOfRotatedBoxesHaveTheClosedForm) {
  for (int k : {2, 3, 4, 6, 8}) {
    for (double half_height : {0.02, 1.0, 8.0}) {
      const double side = 2 * std::tan(kPi / (2 * k));
      const double area = k * side;  // the area of 2k triangles of height 1
      const double mass = 2 * half_height * area;
      // The polar moment of a regular polygon is area * (inradius^2 / 2 + side^2 / 24).
      const double polar = mass * (0.5 + side * side / 24);
      const double lateral = polar / 2 + mass * half_height * half_height / 3;
      const MassProperties expected{mass, Vector3::Zero(),
                                    Vector3(lateral, lateral, polar).asDiagonal()};
      ExpectSame(MassOf(Prism(k, 1, half_height), 1), expected, 1e-9,
                 fmt::format("{} boxes, half height {}", k, half_height));
    }
  }
}

TEST(MassTest, BoxesAtOddAnglesAreExact) {
  RandomStream random(kSeed, "odd angles");
  for (int i = 0; i < 50; ++i) {
    // A small box inside a large one adds no volume. A box far away adds its own volume.
    const Box large = RandomBox(random, 1, 0.5, 1);
    const Box inside = Box{RandomPose(random, 0.1), {0.2, 0.1, 0.1}}.Transformed(large.X_FrameBox);
    Box apart = RandomBox(random, 1, 0.1, 1);
    apart.X_FrameBox.translation() += Vector3(5, 0, 0);
    const std::array<Box, 3> boxes = {inside, large, apart};
    const MassProperties expected = Combined(SolidBox(large, 1), SolidBox(apart, 1), 1);
    ExpectSame(MassOf(boxes, 1), expected, 1e-9, fmt::format("draw {} seed {}", i, kSeed));
  }
}

}  // namespace
}  // namespace assay::geometry::box_test
