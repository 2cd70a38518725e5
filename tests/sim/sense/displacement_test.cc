#include "sim/sense/displacement.h"

#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/geometry/pose.h"

namespace assay::sense::displacement_test {
namespace {

using geometry::Pose;
using geometry::Vector3;

Pose RandomPose(RandomStream& random) {
  return geometry::Translation(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform()) *
         geometry::RotationZ(random.Uniform(-3, 3)) * geometry::RotationX(random.Uniform(-3, 3)) *
         geometry::RotationY(random.Uniform(-3, 3));
}

Displacement RandomDisplacement(RandomStream& random) {
  return {random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1),
          random.Uniform(-3, 3)};
}

// In Spar's equation 2, the origin moves by (x, y, z), and the part turns about it.
TEST(Displacement, MovesTheOriginAndTurnsAboutIt) {
  RandomStream random(1, "displacement");
  for (int i = 0; i < 100; ++i) {
    const Pose pose = RandomPose(random);
    const Displacement d = RandomDisplacement(random);
    const Pose moved = Displaced(pose, d);
    const Vector3 expected = pose.translation() + d.head<3>();
    EXPECT_NEAR((moved.translation() - expected).norm(), 0, 1e-12);
    const Vector3 p(0.1, -0.2, 0.3);
    const Vector3 turned = geometry::RotationZ(d[3]) * (pose.linear() * p);
    EXPECT_NEAR((moved.linear() * p - turned).norm(), 0, 1e-12);
  }
}

TEST(Displacement, BetweenFindsItAgain) {
  RandomStream random(2, "displacement");
  for (int i = 0; i < 100; ++i) {
    const Pose pose = RandomPose(random);
    const Displacement d = RandomDisplacement(random);
    EXPECT_NEAR((Between(pose, Displaced(pose, d)) - d).norm(), 0, 1e-9);
    EXPECT_TRUE(Displaced(Displaced(pose, d), -d).isApprox(pose, 1e-12));
  }
}

}  // namespace
}  // namespace assay::sense::displacement_test
