#include "sim/execution/control/holding.h"

#include <gtest/gtest.h>

#include <cmath>

namespace assay::execution::holding_test {
namespace {

using geometry::Vector3;

constexpr double kLength = 0.02;

plan::StrategyContact Touching(const Vector3& normal, const Vector3& at) {
  return {"", normal.normalized(), at};
}

Holding Down(const std::vector<plan::StrategyContact>& contacts, double friction) {
  return HoldingOf(contacts, -Vector3::UnitZ(), friction, kLength);
}

TEST(Holding, NothingTouches) { EXPECT_EQ(Down({}, 1), Holding::kNothing); }

TEST(Holding, AFloorIsAnObstacleAndAWallIsNone) {
  EXPECT_EQ(Down({Touching(Vector3::UnitZ(), Vector3::Zero())}, 0), Holding::kObstacle);
  EXPECT_EQ(Down({Touching(Vector3::UnitX(), Vector3::Zero())}, 0.5), Holding::kNothing);
}

// A tilted peg of width 1 is in its hole by a depth d. Its tip touches the wall, and its other side
// touches the rim. It wedges if the line between the contacts is in both friction cones, which is
// the case if f > d (Whitney 1982).
TEST(Holding, ATiltedPegWedgesIfTheLineBetweenItsContactsIsInBothFrictionCones) {
  constexpr double kWidth = 0.02;
  for (const double depth : {0.1, 0.3, 1.0}) {
    const std::vector<plan::StrategyContact> two = {
        Touching(Vector3::UnitX(), {-kWidth / 2, 0, 0}),
        Touching(-Vector3::UnitX(), {kWidth / 2, 0, depth * kWidth})};
    EXPECT_EQ(Down(two, 1.1 * depth), Holding::kWedge) << depth;
    EXPECT_NE(Down(two, 0.9 * depth), Holding::kWedge) << depth;
  }
}

// The walls of a funnel lean against the push, but too little to count as an obstacle. They could
// take up the push only with friction.
TEST(Holding, SteepSidesJamWithFrictionOnly) {
  std::vector<plan::StrategyContact> sides;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0})
      sides.push_back(Touching({-x, 0, -0.1}, {0.01 * x, 0.01 * y, 0}));
  }
  EXPECT_EQ(Down(sides, 0), Holding::kNothing);
  EXPECT_EQ(Down(sides, 0.05), Holding::kNothing);
}

}  // namespace
}  // namespace assay::execution::holding_test
