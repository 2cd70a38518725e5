#include "planner/geometry/solids/convex_cut.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "planner/geometry/hull.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/solids/mass_properties.h"
#include "planner/geometry/solids/shadow.h"
#include "tests/oracle/random_pose.h"

namespace assay::geometry::convex_cut_test {
namespace {

using oracle::RandomBox;
using oracle::RandomPose;
using oracle::RandomVector;

constexpr std::uint64_t kSeed = 83;
constexpr double kPi = std::numbers::pi;

ConvexHull RandomSolid(RandomStream& random, int points) {
  std::vector<Vector3> cloud;
  for (int i = 0; i < points; ++i) cloud.push_back(RandomVector(random, 1));
  return HullOf(cloud);
}

ConvexHull Placed(ConvexHull solid, const Vector3& by) {
  for (Vector3& vertex : solid.vertices) vertex += by;
  for (Facet& facet : solid.facets) facet.offset += facet.normal.dot(by);
  return solid;
}

// A regular prism about the z axis, as the hull of its corners.
ConvexHull Prism(int sides, double radius, double half_height) {
  std::vector<Vector3> corners;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    for (const double z : {-half_height, half_height})
      corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  return HullOf(corners);
}

// Returns how far a point is outside of a solid; negative inside.
double Outside(const ConvexHull& solid, const Vector3& p) {
  double outside = -1e9;
  for (const Facet& facet : solid.facets)
    outside = std::max(outside, facet.normal.dot(p) - facet.offset);
  return outside;
}

int Containing(std::span<const ConvexHull> solids, const Vector3& p) {
  return static_cast<int>(
      std::ranges::count_if(solids, [&](const ConvexHull& s) { return Outside(s, p) < 0; }));
}

// Expects that every edge is shared by two facets that run along it in opposite directions, and
// that every vertex lies on or below every facet.
void ExpectConvex(const ConvexHull& solid) {
  std::map<std::pair<int, int>, int> edges;
  for (const Facet& facet : solid.facets) {
    for (std::size_t i = 0; i < facet.loop.size(); ++i)
      ++edges[{facet.loop[i], facet.loop[(i + 1) % facet.loop.size()]}];
    for (const Vector3& vertex : solid.vertices)
      EXPECT_LE(facet.normal.dot(vertex), facet.offset + 1e-8);
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

TEST(ConvexCut, BothSidesOfAPlaneMakeTheWhole) {
  RandomStream random(kSeed, "cut");
  for (int round = 0; round < 300; ++round) {
    const ConvexHull solid = RandomSolid(random, 5 + round % 20);
    const Plane plane{RandomVector(random, 1).normalized(), random.Uniform(-0.5, 0.5)};
    const auto below = Below(solid, plane);
    const auto above = Below(solid, {-plane.normal, -plane.height});
    double volume = 0;
    if (below) ExpectConvex(*below), volume += Volume(*below);
    if (above) ExpectConvex(*above), volume += Volume(*above);
    EXPECT_NEAR(volume, Volume(solid), 1e-9);
    for (int i = 0; i < 50; ++i) {
      const Vector3 p = RandomVector(random, 1);
      if (std::abs(plane.Above(p)) < 1e-6 || std::abs(Outside(solid, p)) < 1e-6) continue;
      const bool is_in = Outside(solid, p) < 0 && plane.Above(p) < 0;
      EXPECT_EQ(below && Outside(*below, p) < 0, is_in);
    }
  }
}

TEST(ConvexCut, APlaneThroughCornersEdgesOrAFaceLeavesNoSliver) {
  const ConvexHull cube = HullOf(Box{Pose::Identity(), {1, 1, 1}});
  EXPECT_EQ(Below(cube, {Vector3::UnitX(), 1})->facets.size(), 6u);
  EXPECT_FALSE(Below(cube, {Vector3::UnitX(), -1}));
  EXPECT_FALSE(Below(cube, {Vector3(1, 1, 0).normalized(), -std::sqrt(2.0)}));
  const auto half = Below(cube, {Vector3(1, 1, 0).normalized(), 0});
  ASSERT_TRUE(half);
  ExpectConvex(*half);
  EXPECT_EQ(half->facets.size(), 5u);
  EXPECT_NEAR(Volume(*half), 4, 1e-12);
  const auto corner = Below(cube, {Vector3(1, 1, 1).normalized(), 1 / std::sqrt(3.0)});
  ASSERT_TRUE(corner);
  EXPECT_NEAR(Volume(*corner), 8 - 8.0 / 6, 1e-12);  // a corner with edges of 2 is cut off
}

TEST(ConvexCut, AHolePlusWhatItCutsIsTheSolid) {
  RandomStream random(kSeed, "cut1");
  for (int round = 0; round < 200; ++round) {
    const ConvexHull solid = RandomSolid(random, 12);
    const ConvexHull pocket = Placed(RandomSolid(random, 8), RandomVector(random, 0.7));
    const std::vector<ConvexHull> pieces = Without(solid, pocket);
    const auto common = Intersection(solid, pocket);
    double volume = common ? Volume(*common) : 0;
    for (const ConvexHull& piece : pieces) ExpectConvex(piece), volume += Volume(piece);
    EXPECT_NEAR(volume, Volume(solid), 1e-9);
    for (int i = 0; i < 100; ++i) {
      const Vector3 p = RandomVector(random, 1);
      const bool is_kept = Outside(solid, p) < 0 && Outside(pocket, p) > 0;
      if (std::abs(Outside(solid, p)) < 1e-6 || std::abs(Outside(pocket, p)) < 1e-6) continue;
      EXPECT_LE(Containing(pieces, p), is_kept ? 1 : 0);
    }
  }
}

TEST(ConvexCut, ABlindRoundHoleHasAFloorInOnePieceAndOneWallForEachSide) {
  const ConvexHull block = HullOf(Box{Pose::Identity(), {0.05, 0.05, 0.05}});
  const ConvexHull hole = Placed(Prism(16, 0.01, 0.04), {0, 0, 0.05});
  const std::vector<ConvexHull> pieces = Without(block, hole);
  EXPECT_EQ(pieces.size(), 17u);
  double volume = 0;
  for (const ConvexHull& piece : pieces) volume += Volume(piece);
  EXPECT_NEAR(volume, 1e-3 - Volume(hole) / 2, 1e-15);
}

TEST(ConvexCut, MassOfAPrismComesNearTheCylinders) {
  const ConvexHull prism[] = {Prism(512, 0.02, 0.05)};
  const MassProperties mass = MassOf(prism, 1000);
  const double cylinder = 1000 * kPi * 0.02 * 0.02 * 0.1;
  EXPECT_NEAR(mass.mass, cylinder, 1e-4 * cylinder);
  EXPECT_NEAR(mass.inertia(2, 2), cylinder * 0.02 * 0.02 / 2, 1e-4 * cylinder * 2e-4);
  EXPECT_NEAR(mass.inertia(0, 0), cylinder * (3 * 4e-4 + 0.01) / 12, 1e-4 * cylinder * 1e-3);
  EXPECT_NEAR(mass.center.norm(), 0, 1e-12);
}

TEST(ConvexCut, ThePointsOfAnInsetSolidAreThatDeep) {
  RandomStream random(kSeed, "cut3");
  for (int round = 0; round < 50; ++round) {
    const ConvexHull solid = RandomSolid(random, 15);
    const double depth = random.Uniform(0.01, 0.2);
    const auto inset = Inset(solid, depth);
    for (int i = 0; i < 100; ++i) {
      const Vector3 p = RandomVector(random, 1);
      if (std::abs(Outside(solid, p) + depth) < 1e-6) continue;
      EXPECT_EQ(inset && Outside(*inset, p) < 0, Outside(solid, p) < -depth);
    }
  }
}

}  // namespace
}  // namespace assay::geometry::convex_cut_test
