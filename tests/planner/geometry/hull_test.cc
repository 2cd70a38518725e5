#include "planner/geometry/hull.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "planner/geometry/box.h"
#include "planner/geometry/pose.h"
#include "tests/oracle/box_pair.h"
#include "tests/oracle/random_pose.h"

namespace assay::geometry::hull_test {
namespace {

using oracle::RandomBox;
using oracle::RandomPose;
using oracle::RandomVector;

constexpr std::uint64_t kSeed = 41;
constexpr double kPi = std::numbers::pi;

// Returns the volume by the divergence theorem: a third of the sum of offset times area of all
// facets.
double VolumeOf(const ConvexHull& hull) {
  double volume = 0;
  for (const Facet& facet : hull.facets) {
    for (size_t i = 2; i < facet.loop.size(); ++i) {
      const Vector3& a = hull.vertices[facet.loop[0]];
      volume += a.dot(hull.vertices[facet.loop[i - 1]].cross(hull.vertices[facet.loop[i]])) / 6;
    }
  }
  return volume;
}

// Expects that every edge is shared by two facets that run along it in opposite directions, and
// that Euler's formula holds.
void ExpectClosed(const ConvexHull& hull) {
  std::map<std::pair<int, int>, int> edges;
  for (const Facet& facet : hull.facets) {
    for (size_t i = 0; i < facet.loop.size(); ++i) {
      ++edges[{facet.loop[i], facet.loop[(i + 1) % facet.loop.size()]}];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
  EXPECT_EQ(hull.vertices.size() + hull.facets.size(), edges.size() / 2 + 2);
}

void ExpectHullOf(const ConvexHull& hull, std::span<const Vector3> points, double tolerance) {
  ExpectClosed(hull);
  for (const Facet& facet : hull.facets) {
    EXPECT_NEAR(facet.normal.norm(), 1, 1e-12);
    for (const Vector3& p : points) EXPECT_LE(facet.normal.dot(p), facet.offset + tolerance);
    for (int i : facet.loop) {
      EXPECT_NEAR(facet.normal.dot(hull.vertices[i]), facet.offset, tolerance);
    }
  }
  auto next = points.begin();  // vertices are input points in the order of the input
  for (const Vector3& vertex : hull.vertices) {
    next = std::find(next, points.end(), vertex);
    ASSERT_NE(next, points.end());
    ++next;
  }
}

std::vector<Vector3> CornersOf(std::span<const Box> boxes) {
  std::vector<Vector3> corners;
  for (const Box& box : boxes) {
    for (const Vector3& corner : box.Corners()) corners.push_back(corner);
  }
  return corners;
}

TEST(HullTest, TetrahedronDropsInnerAndRepeatedPoints) {
  const std::vector<Vector3> points = {{0, 0, 0}, {1, 0, 0}, {0.1, 0.1, 0.1}, {0, 1, 0},
                                       {1, 0, 0}, {0, 0, 1}, {0.5, 0.5, 0}};
  const ConvexHull hull = HullOf(points);
  EXPECT_EQ(hull.vertices, (std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(hull.facets.size(), 4u);
  EXPECT_NEAR(VolumeOf(hull), 1.0 / 6, 1e-14);
  ExpectHullOf(hull, points, 1e-12);
}

TEST(HullTest, RandomBoxesHaveSixFacetsOfFourCorners) {
  RandomStream random(kSeed, "boxes");
  for (int i = 0; i < 300; ++i) {
    const Box box = RandomBox(random, 2, 0.001, 1);
    std::vector<Vector3> points = CornersOf(std::span(&box, 1));
    for (int k = 0; k < 20; ++k) {  // points inside the box, on its faces and on its edges
      Vector3 p = RandomVector(random, 1);
      for (int fixed = random.Index(3); fixed > 0; --fixed) p[random.Index(3)] = 1;
      points.push_back(box.X_FrameBox * p.cwiseProduct(box.half_extents));
    }
    const ConvexHull hull = HullOf(points);
    EXPECT_EQ(hull.vertices.size(), 8u) << "draw " << i;
    EXPECT_EQ(hull.facets.size(), 6u) << "draw " << i;
    for (const Facet& facet : hull.facets) EXPECT_EQ(facet.loop.size(), 4u);
    EXPECT_NEAR(VolumeOf(hull), oracle::VolumeOf(box), 1e-9) << "draw " << i;
    ExpectHullOf(hull, points, 1e-9);
  }
}

// The hull of a box is made without Qhull. Its vertices, its facets and their order must agree with
// those from Qhull.
TEST(HullTest, ABoxHasTheHullOfItsCorners) {
  RandomStream random(kSeed, "corners");
  for (int i = 0; i < 300; ++i) {
    const Box box = RandomBox(random, 2, 0.001, 1);
    const ConvexHull hull = HullOf(box);
    const ConvexHull of_corners = HullOf(box.Corners());
    EXPECT_EQ(hull.vertices, of_corners.vertices) << "draw " << i;
    ASSERT_EQ(hull.facets.size(), of_corners.facets.size()) << "draw " << i;
    for (std::size_t k = 0; k < hull.facets.size(); ++k) {
      EXPECT_EQ(hull.facets[k].loop, of_corners.facets[k].loop) << "draw " << i;
    }
    ExpectHullOf(hull, box.Corners(), 1e-12);
  }
}

TEST(HullTest, PrismsOfRotatedBoxesHaveTheirFacets) {
  RandomStream random(kSeed, "prisms");
  for (int k : {2, 3, 4, 6, 8}) {
    for (int i = 0; i < 20; ++i) {
      const Pose X = RandomPose(random, 1);
      std::vector<Box> boxes;
      for (int b = 0; b < k; ++b) {
        boxes.push_back({X * RotationZ(b * kPi / k), {0.02, 0.02 * std::tan(kPi / (2 * k)), 0.03}});
      }
      const std::vector<Vector3> points = CornersOf(boxes);
      const ConvexHull hull = HullOf(points);
      EXPECT_EQ(hull.vertices.size(), 4u * k);
      EXPECT_EQ(hull.facets.size(), 2u * k + 2);
      EXPECT_NEAR(VolumeOf(hull), 0.06 * 2 * k * 0.0004 * std::tan(kPi / (2 * k)), 1e-12);
      ExpectHullOf(hull, points, 1e-9);
    }
  }
}

TEST(HullTest, RandomPointsLieInsideAClosedSurface) {
  RandomStream random(kSeed, "points");
  for (int i = 0; i < 200; ++i) {
    std::vector<Vector3> points;
    for (int k = 5 + random.Index(60); k > 0; --k) points.push_back(RandomVector(random, 1));
    ExpectHullOf(HullOf(points), points, 1e-6);
  }
}

TEST(HullTest, GridPointsWithManyCoplanarOnesFormAClosedSurface) {
  RandomStream random(kSeed, "grid");
  for (int i = 0; i < 300; ++i) {
    const Pose X = RandomPose(random, 10);
    std::vector<Vector3> points = {X * Vector3(0, 0, 0), X * Vector3(4, 0, 0), X * Vector3(0, 4, 0),
                                   X * Vector3(0, 0, 4)};
    for (int k = random.Index(40); k > 0; --k) {
      const int x = random.Index(5), y = random.Index(5);
      points.push_back(X * Vector3(x, y, random.Index(5)));
    }
    SCOPED_TRACE(fmt::format("draw {} seed {}", i, kSeed));
    ExpectHullOf(HullOf(points), points, 1e-9);
  }
}

TEST(HullTest, OrderDoesNotChangeUnderRigidMotion) {
  RandomStream random(kSeed, "order");
  for (int i = 0; i < 100; ++i) {
    const std::array<Box, 2> boxes = {RandomBox(random, 0.3, 0.1, 1),
                                      RandomBox(random, 0.3, 0.1, 1)};
    const Pose X = RandomPose(random, 3);
    const std::vector<Vector3> points = CornersOf(boxes);
    std::vector<Vector3> moved;
    for (const Vector3& p : points) moved.push_back(X * p);
    const ConvexHull hull = HullOf(points), moved_hull = HullOf(moved);
    ASSERT_EQ(hull.facets.size(), moved_hull.facets.size());
    for (size_t k = 0; k < hull.facets.size(); ++k) {
      EXPECT_EQ(hull.facets[k].loop, moved_hull.facets[k].loop);
      EXPECT_LT((X.linear() * hull.facets[k].normal - moved_hull.facets[k].normal).norm(), 1e-9);
    }
  }
}

TEST(HullDeathTest, FlatPointsStopTheProgram) {
  const std::vector<Vector3> square = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.2, 0}};
  EXPECT_DEATH(HullOf(square), "three dimensions");
  EXPECT_DEATH(HullOf(std::vector<Vector3>(9, Vector3(1, 2, 3))), "three dimensions");
  EXPECT_DEATH(HullOf(std::vector<Vector3>()), "three dimensions");
}

TEST(LowestPoint, IsTheLowestCorner) {
  RandomStream random(kSeed, "lowest");
  for (int i = 0; i < 100; ++i) {
    const std::array<Box, 2> boxes = {oracle::RandomBox(random, 1.0, 0.1, 0.8),
                                      oracle::RandomBox(random, 1.0, 0.1, 0.8)};
    double lowest = 10;
    for (const Box& box : boxes) {
      for (const Vector3& corner : box.Corners()) lowest = std::min(lowest, corner.z());
    }
    EXPECT_NEAR(LowestPoint(HullsOf(boxes)), lowest, 1e-12) << "seed " << kSeed;
  }
}

TEST(AsBox, RecognizesBoxesAtAnyPose) {
  RandomStream random(kSeed, "as box");
  for (int i = 0; i < 500; ++i) {
    const Box box = oracle::RandomBox(random, 1.0, 0.1, 0.8);
    const std::optional<Box> same = AsBox(HullOf(HullOf(box).vertices));
    ASSERT_TRUE(same.has_value()) << "seed " << kSeed;
    for (const Vector3& corner : box.Corners()) {
      EXPECT_TRUE(oracle::IsWithin(*same, corner, 1e-9));
      EXPECT_FALSE(oracle::IsWithin(*same, corner, -1e-9));
    }
    EXPECT_NEAR(oracle::VolumeOf(*same), oracle::VolumeOf(box), 1e-9);
    EXPECT_NEAR(same->X_FrameBox.linear().determinant(), 1, 1e-9);
  }
}

TEST(AsBox, RefusesWhatIsNearlyABox) {
  RandomStream random(kSeed, "no box");
  for (int i = 0; i < 500; ++i) {
    const Box box = oracle::RandomBox(random, 1.0, 0.1, 0.8);
    ConvexHull hull = HullOf(box);
    hull.vertices[static_cast<std::size_t>(random.Index(8))] += oracle::RandomVector(random, 0.01);
    EXPECT_FALSE(AsBox(HullOf(hull.vertices)).has_value()) << "seed " << kSeed;
  }
}

TEST(FacetsByAxis, OfAnAlignedBoxGoFromLowXToHighZ) {
  const ConvexHull cube = HullOf(Box::FromCorners(Vector3::Zero(), Vector3::Ones()));
  const auto sides = FacetsByAxis(cube);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(sides[i]->normal,
              Vector3((i % 2 == 0 ? -1 : 1) * Vector3::Unit(static_cast<int>(i / 2))));
  }
}

}  // namespace
}  // namespace assay::geometry::hull_test
