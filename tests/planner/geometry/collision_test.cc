#include "planner/geometry/collision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "planner/geometry/box.h"
#include "planner/geometry/hull.h"
#include "planner/geometry/pose.h"
#include "planner/geometry/solids/convex_cut.h"
#include "tests/oracle/box_pair.h"
#include "tests/oracle/random_pose.h"

namespace assay::geometry::collision_test {
namespace {

using oracle::RandomBox;
using oracle::RandomPose;
using oracle::RandomQuarterTurns;
using oracle::RandomVector;

constexpr std::uint64_t kSeed = 51;
constexpr double kAccuracy = 1e-7;  // metres, the accuracy of distances

CollisionShape ShapeOf(const Box& box) { return CollisionShape(std::span(&box, 1)); }

bool BoxesOverlap(const Box& a, const Box& b, double allowance) {
  return Overlaps(ShapeOf(a), Pose::Identity(), ShapeOf(b), Pose::Identity(), allowance);
}

double BoxDistance(const Box& a, const Box& b) {
  return Distance(ShapeOf(a), Pose::Identity(), ShapeOf(b), Pose::Identity());
}

Box Shrunk(const Box& box, double allowance) {
  return {box.X_FrameBox, box.half_extents.array() - allowance / 2};
}

struct BoxPair {
  Box a;
  Box b;
};

// Draws a pair of boxes at random angles, at quarter turns, or at angles that differ from these by
// 1e-12 to 1e-3.
BoxPair RandomPair(RandomStream& random, double reach) {
  BoxPair pair{RandomBox(random, reach, 0.005, 0.1), RandomBox(random, reach, 0.005, 0.1)};
  const int kind = random.Index(3);
  if (kind == 0) return pair;
  Matrix3 turns = RandomQuarterTurns(random);
  if (kind == 2) {
    const double angle = std::pow(10.0, random.Uniform(-12, -3));
    turns = turns * Eigen::AngleAxisd(angle, RandomVector(random, 1).normalized());
  }
  pair.b.X_FrameBox.linear() = pair.a.X_FrameBox.linear() * turns;
  return pair;
}

// Moves b along one of a's axes until its nearest corner is `gap` away from the face.
void Slide(BoxPair& pair, int axis, double gap) {
  const Pose X_ABox = pair.a.X_FrameBox.inverse() * pair.b.X_FrameBox;
  const double reach = X_ABox.linear().row(axis).cwiseAbs() * pair.b.half_extents;
  Vector3 p = X_ABox.translation();
  p[axis] = pair.a.half_extents[axis] + reach + gap;
  pair.b.X_FrameBox.translation() = pair.a.X_FrameBox * p;
}

TEST(CollisionTest, OverlapOfTwoBoxesAgreesWithTheSeparatingAxisTest) {
  RandomStream random(kSeed, "overlap");
  int overlapping = 0;
  for (int i = 0; i < 40000; ++i) {
    const BoxPair pair = RandomPair(random, 0.12);
    const double allowance = i % 2 == 0 ? 0 : random.Uniform(0, 0.004);
    const double separation =
        oracle::Separation(Shrunk(pair.a, allowance), Shrunk(pair.b, allowance));
    if (std::abs(separation) < 1e-8) continue;
    EXPECT_EQ(BoxesOverlap(pair.a, pair.b, allowance), separation < 0)
        << "draw " << i << " seed " << kSeed << " separation " << separation;
    overlapping += int{separation < 0};
  }
  EXPECT_GT(overlapping, 8000);
  EXPECT_LT(overlapping, 32000);
}

TEST(CollisionTest, FacesThatTouchDoNotOverlapAndDeeperOnesDo) {
  RandomStream random(kSeed, "touch");
  for (int i = 0; i < 20000; ++i) {
    BoxPair pair = RandomPair(random, 0.03);
    const int axis = random.Index(3);
    Slide(pair, axis, 0);
    EXPECT_FALSE(BoxesOverlap(pair.a, pair.b, 0)) << "draw " << i << " seed " << kSeed;
    EXPECT_NEAR(BoxDistance(pair.a, pair.b), oracle::DisjointDistance(pair.a, pair.b), kAccuracy)
        << "draw " << i << " seed " << kSeed;
    Slide(pair, axis, 1e-8);
    EXPECT_FALSE(BoxesOverlap(pair.a, pair.b, 0)) << "draw " << i << " seed " << kSeed;
    Slide(pair, axis, -1e-6);
    const double separation = oracle::Separation(pair.a, pair.b);
    if (std::abs(separation) < 1e-8) continue;
    EXPECT_EQ(BoxesOverlap(pair.a, pair.b, 0), separation < 0) << "draw " << i << " seed " << kSeed;
    EXPECT_FALSE(BoxesOverlap(pair.a, pair.b, 2e-6)) << "draw " << i << " seed " << kSeed;
  }
}

TEST(CollisionTest, ParallelFacesCountFromTheAllowanceOn) {
  for (double allowance : {0.0, 1e-5, 1e-4, 1e-3}) {
    const Box cube{Pose::Identity(), {0.05, 0.05, 0.05}};
    const Box less = cube.Transformed(Translation(0.1 - allowance, 0.01, 0));
    const Box more = cube.Transformed(Translation(0.1 - allowance - 1e-7, 0.01, 0));
    EXPECT_FALSE(BoxesOverlap(cube, less, allowance));
    EXPECT_TRUE(BoxesOverlap(cube, more, allowance));
  }
}

TEST(CollisionTest, PlateThinnerThanTheAllowanceStillStopsABlock) {
  const Box plate{Pose::Identity(), {0.1, 0.1, 1e-4}};
  const Box block{Translation(0, 0, 0.02), {0.05, 0.05, 0.05}};
  EXPECT_TRUE(BoxesOverlap(plate, block, 1e-3));
}

TEST(CollisionTest, DistanceOfTwoBoxesAgreesWithTheClosedForm) {
  RandomStream random(kSeed, "distance");
  int apart = 0;
  for (int i = 0; i < 40000; ++i) {
    const BoxPair pair = RandomPair(random, 0.25);
    const double separation = oracle::Separation(pair.a, pair.b);
    if (std::abs(separation) < 1e-8) continue;
    const double expected = separation < 0 ? 0 : oracle::DisjointDistance(pair.a, pair.b);
    EXPECT_NEAR(BoxDistance(pair.a, pair.b), expected, kAccuracy)
        << "draw " << i << " seed " << kSeed;
    apart += int{separation > 0};
  }
  EXPECT_GT(apart, 20000);
}

TEST(CollisionTest, SmallDistancesOfFacesAgreeWithTheClosedForm) {
  RandomStream random(kSeed, "near");
  for (int i = 0; i < 20000; ++i) {
    BoxPair pair = RandomPair(random, 0.1);
    Slide(pair, random.Index(3), std::pow(10.0, random.Uniform(-7, -2)));
    EXPECT_NEAR(BoxDistance(pair.a, pair.b), oracle::DisjointDistance(pair.a, pair.b), kAccuracy)
        << "draw " << i << " seed " << kSeed;
  }
}

struct Shape {
  std::vector<Box> boxes;
  Pose X_WorldShape;

  CollisionShape Prepared() const { return CollisionShape(boxes); }
};

Shape RandomShape(RandomStream& random, double reach) {
  Shape shape{{}, RandomPose(random, reach)};
  for (int i = 1 + random.Index(6); i > 0; --i) {
    shape.boxes.push_back(RandomBox(random, 0.1, 0.005, 0.05));
  }
  return shape;
}

// The oracle's answer: the least values over all pairs of boxes, in the world frame.
struct Nearest {
  double separation = std::numeric_limits<double>::infinity();
  double distance = std::numeric_limits<double>::infinity();
};

Nearest NaiveNearest(const Shape& a, const Shape& b) {
  Nearest nearest;
  for (const Box& a_box : a.boxes) {
    for (const Box& b_box : b.boxes) {
      const Box a_World = a_box.Transformed(a.X_WorldShape);
      const Box b_World = b_box.Transformed(b.X_WorldShape);
      const double separation = oracle::Separation(a_World, b_World);
      nearest.separation = std::min(nearest.separation, separation);
      nearest.distance = std::min(nearest.distance,
                                  separation < 0 ? 0 : oracle::DisjointDistance(a_World, b_World));
    }
  }
  return nearest;
}

TEST(CollisionTest, UnionsAgreeWithEveryBoxAgainstEveryBox) {
  RandomStream random(kSeed, "unions");
  int overlapping = 0;
  for (int i = 0; i < 3000; ++i) {
    const Shape a = RandomShape(random, 0.2), b = RandomShape(random, 0.2);
    const Nearest nearest = NaiveNearest(a, b);
    if (std::abs(nearest.separation) < 1e-8) continue;
    const CollisionShape a_shape = a.Prepared(), b_shape = b.Prepared();
    EXPECT_EQ(Overlaps(a_shape, a.X_WorldShape, b_shape, b.X_WorldShape, 0), nearest.separation < 0)
        << "draw " << i << " seed " << kSeed;
    EXPECT_NEAR(Distance(a_shape, a.X_WorldShape, b_shape, b.X_WorldShape), nearest.distance,
                kAccuracy)
        << "draw " << i << " seed " << kSeed;
    overlapping += int{nearest.separation < 0};
  }
  EXPECT_GT(overlapping, 300);
  EXPECT_LT(overlapping, 2700);
}

TEST(CollisionTest, SymmetricAndInvariantUnderACommonMotion) {
  RandomStream random(kSeed, "symmetry");
  for (int i = 0; i < 3000; ++i) {
    const Shape a = RandomShape(random, 0.2), b = RandomShape(random, 0.2);
    const CollisionShape a_shape = a.Prepared(), b_shape = b.Prepared();
    const Pose X = RandomPose(random, 1);
    const double distance = Distance(a_shape, a.X_WorldShape, b_shape, b.X_WorldShape);
    EXPECT_NEAR(distance, Distance(b_shape, b.X_WorldShape, a_shape, a.X_WorldShape), kAccuracy);
    EXPECT_NEAR(distance, Distance(a_shape, X * a.X_WorldShape, b_shape, X * b.X_WorldShape),
                kAccuracy);
    const bool overlaps = Overlaps(a_shape, a.X_WorldShape, b_shape, b.X_WorldShape, 1e-4);
    EXPECT_EQ(overlaps, Overlaps(b_shape, b.X_WorldShape, a_shape, a.X_WorldShape, 1e-4));
    EXPECT_EQ(overlaps, Overlaps(a_shape, X * a.X_WorldShape, b_shape, X * b.X_WorldShape, 1e-4));
    if (overlaps) {
      EXPECT_TRUE(Overlaps(a_shape, a.X_WorldShape, b_shape, b.X_WorldShape, 0));
      EXPECT_EQ(distance, 0);
    }
  }
}

TEST(CollisionTest, RadiusHoldsEveryCorner) {
  RandomStream random(kSeed, "radius");
  for (int i = 0; i < 100; ++i) {
    const Shape shape = RandomShape(random, 0);
    double farthest = 0;
    for (const Box& box : shape.boxes) {
      for (const Vector3& corner : box.Corners()) farthest = std::max(farthest, corner.norm());
    }
    EXPECT_DOUBLE_EQ(shape.Prepared().radius(), farthest);
  }
}

TEST(CollisionTest, EmptyShapeOverlapsNothingAndIsInfinitelyFar) {
  const CollisionShape empty(std::span<const Box>{});
  const CollisionShape cube = ShapeOf({Pose::Identity(), {1, 1, 1}});
  EXPECT_FALSE(Overlaps(empty, Pose::Identity(), cube, Pose::Identity(), 0));
  EXPECT_TRUE(std::isinf(Distance(empty, Pose::Identity(), cube, Pose::Identity())));
}

TEST(CollisionTest, PegInAHoleTouchesNoWallUntilTheClearanceIsUsedUp) {
  const Box block = Box::FromCorners({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05});
  const CollisionShape ring(
      Without(HullOf(block), HullOf(Box{Translation(0, 0, 0.02), {0.02, 0.02, 0.04}})));
  const CollisionShape peg = ShapeOf({Translation(0, 0, 0.03), {0.0195, 0.0195, 0.04}});
  const auto overlaps = [&](const Pose& X_WorldPeg) {
    return Overlaps(ring, Pose::Identity(), peg, X_WorldPeg, 0);
  };
  EXPECT_FALSE(overlaps(Pose::Identity()));
  EXPECT_FALSE(overlaps(Translation(0.0005, 0.0005, -0.01))) << "touching two walls and the floor";
  EXPECT_TRUE(overlaps(Translation(0.00051, 0, 0)));
  EXPECT_TRUE(overlaps(Translation(0, 0, -0.01001)));
  EXPECT_NEAR(Distance(ring, Pose::Identity(), peg, Translation(0.0003, 0, 0)), 0.0002, 1e-9);
}

}  // namespace
}  // namespace assay::geometry::collision_test
