#include "planner/geometry/solids/round_solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/oracle/random_pose.h"

namespace assay::geometry::round_solid_test {
namespace {

constexpr std::uint64_t kSeed = 7;

RoundSolid RandomFrustum(RandomStream& random) {
  return {{oracle::RandomVector(random, 1), oracle::RandomVector(random, 1)},
          {random.Uniform(0.1, 1), random.Uniform(0.1, 1)},
          4 * (2 + random.Index(15))};
}

// Returns the point of the solid's surface at a share of its length and an angle about its axis,
// counted from the side on which the plane is.
Vector3 OnSurface(const RoundSolid& solid, double share, double angle, const Vector3& towards) {
  const Vector3 axis = (solid.ends[1] - solid.ends[0]).normalized();
  const Vector3 u = (towards - towards.dot(axis) * axis).normalized();
  const double radius = std::lerp(solid.radii[0], solid.radii[1], share);
  return solid.ends[0] + share * (solid.ends[1] - solid.ends[0]) +
         radius * (std::cos(angle) * u + std::sin(angle) * axis.cross(u));
}

// The corners of a side of the polygons touch the plane in which the side lies. The round solid
// touches it in the middle between each pair of them, and no point of it is beyond the plane.
TEST(TouchInPlaceOf, TheMiddleOfASideOfThePolygons) {
  RandomStream random(kSeed, "sides");
  for (int trial = 0; trial < 1000; ++trial) {
    RoundSolid solid = RandomFrustum(random);
    const bool is_cylinder = random.Uniform(0, 1) < 0.5;
    if (is_cylinder) solid.radii[1] = solid.radii[0];
    const Vector3 along = solid.ends[1] - solid.ends[0];
    const double half_angle = std::numbers::pi / solid.sides;
    const Vector3 towards = oracle::RandomRotation(random).col(0);
    const double share = random.Uniform(0, 1);
    const Vector3 middle = OnSurface(solid, share, 0, towards);
    const Vector3 radial =
        (towards - towards.dot(along) * along / along.squaredNorm()).normalized();
    const Vector3 normal =
        (along.norm() * radial + (solid.radii[0] - solid.radii[1]) * along.normalized())
            .normalized();
    const Vector3 sideways = along.normalized().cross(radial);
    const double radius = std::lerp(solid.radii[0], solid.radii[1], share);
    for (const double side : {-1.0, 0.3, 1.0}) {
      const Vector3 corner = middle + side * radius * std::tan(half_angle) * sideways;
      const auto touch = TouchInPlaceOf(corner, solid, normal);
      ASSERT_TRUE(touch) << "seed " << kSeed << " trial " << trial;
      EXPECT_LT((*touch - middle).norm(), 1e-6);
    }
    const Vector3 beyond = middle + 1.1 * radius * std::tan(half_angle) * sideways;
    EXPECT_FALSE(TouchInPlaceOf(beyond, solid, normal)) << "seed " << kSeed << " trial " << trial;
    for (int i = 0; i < 20; ++i) {
      const Vector3 p = OnSurface(solid, random.Uniform(0, 1), random.Uniform(-3, 3), towards);
      EXPECT_LT(normal.dot(p - middle), 1e-9) << "seed " << kSeed << " trial " << trial;
    }
  }
}

TEST(TouchInPlaceOf, IsNothingOnAnEndAndOnAFlat) {
  const RoundSolid cylinder = {{Vector3::Zero(), Vector3::UnitZ()}, {1, 1}, 32};
  EXPECT_FALSE(TouchInPlaceOf({0.5, 0, 1}, cylinder, Vector3::UnitZ()));
  EXPECT_FALSE(TouchInPlaceOf({0.9, 0.1, 0.5}, cylinder, Vector3::UnitX()));
  EXPECT_FALSE(TouchInPlaceOf({1, 0, 1.1}, cylinder, Vector3::UnitX()));
}

// A hollow or plain solid whose end alone touches: its rim touches at one point.
TEST(TouchInPlaceOf, OnePointOfARimThatLeans) {
  const RoundSolid cylinder = {{Vector3::Zero(), Vector3::UnitZ()}, {1, 1}, 32};
  const Vector3 normal = Vector3(1, 0, 1).normalized();
  const auto touch = TouchInPlaceOf({1, 0.05, 1}, cylinder, normal);
  ASSERT_TRUE(touch);
  EXPECT_LT((*touch - Vector3(1, 0, 1)).norm(), 1e-9);
}

}  // namespace
}  // namespace assay::geometry::round_solid_test
