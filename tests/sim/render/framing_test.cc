#include "sim/render/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planner/base/random.h"

namespace assay::render::framing_test {
namespace {

// Returns the distance of a ball from the nearest side of the picture, as a fraction of half the
// picture's height. This naive oracle uses the planes of the sides, from the camera's pose and
// angle alone.
double RoomAround(const Ball& ball, const FreeCamera& camera, double aspect) {
  const Vector3 p = camera.X_WorldCamera.inverse() * ball.center;
  const double half = std::tan(camera.vertical_angle / 2);
  double least = 1e9;
  for (const auto& [across, tangent] :
       {std::pair(p.x(), aspect * half), {-p.x(), aspect * half}, {p.y(), half}, {-p.y(), half}}) {
    const double angle = std::atan(tangent);
    const double from_side = -p.z() * std::sin(angle) - across * std::cos(angle);
    least = std::min(least, from_side - ball.radius);
  }
  return least / (-p.z() * half);
}

class FramingTest : public testing::Test {
 protected:
  Vector3 RandomVector(double size) {
    return size * Vector3(random_.Uniform(-1, 1), random_.Uniform(-1, 1), random_.Uniform(-1, 1));
  }
  Vector3 RandomDirection() {
    for (;;) {
      const Vector3 v = RandomVector(1);
      if (v.norm() > 0.1 && v.norm() < 1 && std::abs(v.normalized().z()) < 0.97)
        return v.normalized();
    }
  }

  RandomStream random_{1, "framing"};
};

// All balls are in the picture with a margin, and one of them is near a side. A nearer camera would
// not have all of them in its picture.
TEST_F(FramingTest, AllBallsAreInThePictureAndFillIt) {
  for (int i = 0; i < 300; ++i) {
    std::vector<Ball> balls;
    for (int n = 0; n < 1 + i % 7; ++n) {
      balls.push_back({RandomVector(0.3) + Vector3(0.6, 0, 0.1), random_.Uniform(0.001, 0.1)});
    }
    const double aspect = random_.Uniform(0.3, 3);
    const Vector3 back = RandomDirection();
    const FreeCamera camera = Framing(balls, back, aspect);
    EXPECT_LT((camera.X_WorldCamera.linear().col(2) - back).norm(), 1e-9);
    EXPECT_NEAR(camera.X_WorldCamera.linear().col(0).z(), 0, 1e-9);
    EXPECT_GT(camera.X_WorldCamera.linear().col(1).z(), 0);
    double least = 1e9;
    for (const Ball& ball : balls) least = std::min(least, RoomAround(ball, camera, aspect));
    EXPECT_GT(least, 0.01) << i;
    EXPECT_LT(least, 0.13 * std::max(1.0, aspect)) << i;
  }
}

// The two points lie on a line across the view. The camera looks at their middle, and the picture
// is about as wide as their distance.
TEST_F(FramingTest, KnownAnswer) {
  const std::vector<Ball> ends = {{{0, -0.1, 0}}, {{0, 0.1, 0}}};
  const FreeCamera camera = Framing(ends, Vector3::UnitX(), 2);
  const Vector3& eye = camera.X_WorldCamera.translation();
  EXPECT_NEAR(eye.y(), 0, 1e-12);
  EXPECT_NEAR(eye.z(), 0, 1e-12);
  EXPECT_NEAR(eye.x() * 2 * std::tan(camera.vertical_angle / 2) / 1.1, 0.1, 1e-9);
}

}  // namespace
}  // namespace assay::render::framing_test
