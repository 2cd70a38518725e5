#include "planner/geometry/rounded_hull.h"

#include <gtest/gtest.h>

#include "planner/geometry/collision.h"
#include "planner/geometry/solids/mass_properties.h"
#include "tests/oracle/box_pair.h"
#include "tests/oracle/random_pose.h"

namespace assay::geometry::rounded_hull_test {
namespace {

using oracle::RandomBox;
using oracle::RandomPose;
using oracle::RandomVector;

RoundedHull HullOfBox(const Box& box, double radius = 0) {
  return RoundedHull(box.Corners(), radius);
}

// Boxes are hulls whose distance is known independently.
TEST(RoundedHull, SeparationIsTheDistanceOfBoxesWithoutTheRadii) {
  RandomStream random(61, "separation");
  for (int i = 0; i < 2000; ++i) {
    const Box a = RandomBox(random, 0.3, 0.005, 0.1);
    const Box b = RandomBox(random, 0.3, 0.005, 0.1);
    const double radius = random.Uniform(0, 0.05);
    const double distance = Distance(CollisionShape(std::span(&a, 1)), Pose::Identity(),
                                     CollisionShape(std::span(&b, 1)), Pose::Identity());
    EXPECT_NEAR(Separation(HullOfBox(a, radius), Pose::Identity(), HullOfBox(b), Pose::Identity()),
                std::max(0.0, distance - radius), 2e-7)
        << i;
  }
}

std::vector<Vector3> RandomPoints(RandomStream& random, int count) {
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) points.push_back(RandomVector(random, 0.1));
  return points;
}

// Law: no two points of the bodies are nearer than the separation, and the separation moves with
// the bodies.
TEST(RoundedHull, NoTwoPointsAreNearerThanTheSeparation) {
  RandomStream random(62, "points");
  for (int i = 0; i < 300; ++i) {
    const RoundedHull a(RandomPoints(random, 12));
    const RoundedHull b(RandomPoints(random, 12));
    const Pose X_WorldA = RandomPose(random, 0.3);
    const Pose X_WorldB = RandomPose(random, 0.3);
    const double separation = Separation(a, X_WorldA, b, X_WorldB);
    for (int k = 0; k < 50; ++k) {
      const auto point = [&random](const RoundedHull& hull) {
        Vector3 p = Vector3::Zero();
        double weights = 0;
        for (const Vector3& vertex : hull.vertices()) {
          const double weight = std::pow(random.Uniform(), 8);
          p += weight * vertex;
          weights += weight;
        }
        return Vector3(p / weights);
      };
      EXPECT_GE((X_WorldA * point(a) - X_WorldB * point(b)).norm(), separation - 1e-12);
    }
    const Pose X = RandomPose(random, 1);
    EXPECT_NEAR(Separation(a, X * X_WorldA, b, X * X_WorldB), separation, 1e-6);
  }
}

// Law: the question whether two bodies are at least `enough` apart has the same answer as the
// measured separation.
TEST(RoundedHull, AnythingIsToldFromEnoughOn) {
  RandomStream random(65, "enough");
  for (int i = 0; i < 2000; ++i) {
    const RoundedHull a = HullOfBox(RandomBox(random, 0.3, 0.005, 0.1), random.Uniform(0, 0.02));
    const RoundedHull b(RandomPoints(random, 12));
    const Pose X_WorldA = RandomPose(random, 0.3);
    const Pose X_WorldB = RandomPose(random, 0.3);
    const double separation = Separation(a, X_WorldA, b, X_WorldB);
    const double enough = random.Uniform(0, 0.4);
    const double told = Separation(a, X_WorldA, b, X_WorldB, enough);
    EXPECT_EQ(std::min(told, enough), std::min(separation, enough)) << i;
    EXPECT_GE(told, std::min(separation, enough)) << i;
  }
}

TEST(RoundedHull, VolumeOfABox) {
  RandomStream random(63, "volume");
  const Box box = RandomBox(random, 0.3, 0.005, 0.1);
  EXPECT_NEAR(Volume(HullOfBox(box).core()), oracle::VolumeOf(box), 1e-12);
}

TEST(RoundedHull, TheBallHoldsItAll) {
  RandomStream random(64, "ball");
  const RoundedHull hull(RandomPoints(random, 20), 0.02);
  for (const Vector3& vertex : hull.vertices()) {
    EXPECT_LE((vertex - hull.center()).norm() + 0.02, hull.ball_radius() + 1e-12);
  }
}

}  // namespace
}  // namespace assay::geometry::rounded_hull_test
