#include "planner/motion/collision/shape_hull.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/geometry/hull.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/oracle/random_pose.h"

namespace assay::motion::shape_hull_test {
namespace {

using geometry::Facet;
using geometry::Pose;
using geometry::RoundedHull;
using geometry::Vector3;
using oracle::RandomVector;

// Returns the distance of p outside the hull by its greatest facet; negative inside.
double Outside(const RoundedHull& hull, const Vector3& p) {
  double greatest = -1e9;
  for (const Facet& facet : hull.core().facets) {
    greatest = std::max(greatest, facet.normal.dot(p) - facet.offset);
  }
  return greatest;
}

TEST(ShapeHull, HoldsTheSphereAndTouchesIt) {
  const RoundedHull hull = HullAround(kinematics::SphereShape{0.05}, Pose::Identity());
  EXPECT_EQ(hull.vertices().size(), 12U);
  EXPECT_EQ(hull.core().facets.size(), 20U);
  for (const Facet& facet : hull.core().facets) EXPECT_NEAR(facet.offset, 0.05, 1e-12);
}

TEST(ShapeHull, HoldsTheCylinder) {
  RandomStream random(74, "cylinder");
  const Pose X_LinkShape = oracle::RandomPose(random, 0.3);
  const RoundedHull hull = HullAround(kinematics::CylinderShape{0.1, 0.3}, X_LinkShape);
  double nearest = 1;
  for (int i = 0; i < 1000; ++i) {
    const double angle = random.Uniform(0, 2 * M_PI);
    const Vector3 rim(0.1 * std::cos(angle), 0.1 * std::sin(angle), random.Index(2) ? 0.15 : -0.15);
    EXPECT_LE(Outside(hull, X_LinkShape * rim), 1e-9);
    const Vector3 beyond(1.021 * rim.x(), 1.021 * rim.y(), 0);
    nearest = std::min(nearest, Outside(hull, X_LinkShape * beyond));
  }
  EXPECT_GT(nearest, 0);
}

TEST(ShapeHull, TheBoxIsItself) {
  const RoundedHull hull = HullAround(kinematics::BoxShape{{0.2, 0.4, 0.6}}, Pose::Identity());
  EXPECT_NEAR(Volume(hull.core()), 0.2 * 0.4 * 0.6, 1e-12);
}

}  // namespace
}  // namespace assay::motion::shape_hull_test
