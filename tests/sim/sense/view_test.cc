#include "sim/sense/view.h"

#include <gtest/gtest.h>

#include "planner/base/random.h"

namespace assay::sense::view_test {
namespace {

constexpr int kSize = 480;
const Vector3 kEye(1.4, -0.8, 1.6);
const Vector3 kTarget(0.6, 0.1, 0.05);
constexpr double kRadius = 0.14;

class ViewTest : public testing::Test {
 protected:
  Vector3 RandomPoint() {
    return kTarget + kRadius * Vector3(random_.Uniform(-1, 1), random_.Uniform(-1, 1),
                                       random_.Uniform(-1, 1));
  }

  View view_{kEye, kTarget, kRadius, kSize};
  RandomStream random_{1, "view"};
};

TEST_F(ViewTest, TheTargetIsInTheMiddle) {
  EXPECT_NEAR((view_.Project(kTarget) - Vector2(kSize, kSize) / 2).norm(), 0, 1e-9);
}

// A ray from the eye meets the ball about the target if and only if its pixel is inside the circle
// that touches the picture's sides.
TEST_F(ViewTest, TheBallFillsThePicture) {
  const double distance = (kTarget - kEye).norm();
  for (int i = 0; i < 200; ++i) {
    const Vector3 p = kTarget + 1.2 * (RandomPoint() - kTarget);
    const Vector3 ray = (p - kEye).normalized();
    const double passes_at = (kTarget - kEye).cross(ray).norm();
    const double from_middle = (view_.Project(p) - Vector2(kSize, kSize) / 2).norm();
    EXPECT_LT(passes_at, distance);
    EXPECT_EQ(passes_at < kRadius, from_middle < kSize / 2.0) << passes_at << " " << from_middle;
  }
}

// The oracle is the cosine of the angle between two rays, from the pixels and the angle of the
// picture alone.
TEST_F(ViewTest, PixelsKeepTheAnglesBetweenRays) {
  const double focal = kSize / 2.0 / std::tan(view_.camera().vertical_angle / 2);
  const auto ray_of = [&](const Vector2& pixel) {
    return Vector3(pixel.x() - kSize / 2.0, pixel.y() - kSize / 2.0, focal).normalized();
  };
  for (int i = 0; i < 100; ++i) {
    const Vector3 a = RandomPoint();
    const Vector3 b = RandomPoint();
    EXPECT_NEAR(ray_of(view_.Project(a)).dot(ray_of(view_.Project(b))),
                (a - kEye).normalized().dot((b - kEye).normalized()), 1e-12);
  }
}

TEST_F(ViewTest, ProjectionRateIsTheDifferenceQuotient) {
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 100; ++i) {
    const Vector3 p = RandomPoint();
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 step = kStep * Vector3::Unit(axis);
      const Vector2 quotient = (view_.Project(p + step) - view_.Project(p - step)) / (2 * kStep);
      EXPECT_NEAR((view_.ProjectionRate(p).col(axis) - quotient).norm(), 0, 1e-4);
    }
  }
}

TEST_F(ViewTest, StraightDownIsAView) {
  const View down({0.5, 0, 1}, {0.5, 0, 0}, 0.1, 100);
  EXPECT_NEAR((down.Project({0.5, 0, 0}) - Vector2(50, 50)).norm(), 0, 1e-9);
}

TEST(ViewDeathTest, TheEyeIsOutsideOfTheBall) {
  EXPECT_DEATH(View({0, 0, 1}, {0, 0, 0}, 1.5, 100), "a ball of 1.5 m, 1 m away");
}

}  // namespace
}  // namespace assay::sense::view_test
