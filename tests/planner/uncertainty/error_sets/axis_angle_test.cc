#include "planner/uncertainty/error_sets/axis_angle.h"

#include <gtest/gtest.h>

#include <numbers>

#include "planner/geometry/pose.h"
#include "tests/oracle/random_pose.h"

namespace assay::uncertainty::axis_angle_test {
namespace {

TEST(VerticalInTool, IsTheWorldsZInTheToolsAxes) {
  RandomStream random(1, "tools");
  for (int i = 0; i < 100; ++i) {
    const Pose X = oracle::RandomPose(random, 1);
    EXPECT_LT((X.linear() * VerticalInTool(X) - Vector3::UnitZ()).norm(), 1e-11);
  }
  const Pose down = geometry::RotationZ(0.3) * geometry::RotationX(std::numbers::pi);
  EXPECT_EQ(VerticalInTool(down), Vector3(0, 0, -1));
}

// The bounds must hold for the decomposition of quaternions: the twist is 2 atan2(q . axis, q_w),
// and the swing is the rest of the rotation.
TEST(TwistAndSwing, BoundTheDecompositionOfRotations) {
  RandomStream random(2, "rotations");
  for (int i = 0; i < 2000; ++i) {
    const Vector3 axis = oracle::RandomRotation(random).col(0);
    const Vector3 other = oracle::RandomRotation(random).col(0);
    const double most = random.Uniform(0, 3.1);
    const double angle = i % 2 == 0 ? most : random.Uniform(-most, most);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, axis));
    const double twist = 2 * std::atan2(std::abs(q.vec().dot(other)), std::abs(q.w()));
    const Eigen::AngleAxisd back(-2 * std::atan2(q.vec().dot(other), q.w()), other);
    const double swing = Eigen::AngleAxisd(q * Eigen::Quaterniond(back)).angle();
    EXPECT_LE(twist, TwistOf(most, axis.dot(other)) + 1e-9);
    EXPECT_LE(std::min(swing, 2 * std::numbers::pi - swing), SwingOf(most, axis.dot(other)) + 1e-7);
    if (i % 2 == 0) {  // the bound of the twist is reached
      EXPECT_NEAR(twist, TwistOf(most, axis.dot(other)), 1e-9);
    }
  }
}

TEST(TwistAndSwing, AtTheEnds) {
  EXPECT_EQ(TwistOf(0.1, 0), 0);
  EXPECT_NEAR(TwistOf(0.1, -1), 0.1, 1e-15);
  EXPECT_NEAR(SwingOf(0.1, 0), 0.1, 1e-15);
  EXPECT_EQ(SwingOf(0.1, 1), 0);
  EXPECT_EQ(TwistOf(4, 0), 0);
  EXPECT_NEAR(TwistOf(4, 0.1), std::numbers::pi, 1e-15);
}

}  // namespace
}  // namespace assay::uncertainty::axis_angle_test
