#include "planner/budget/pareto_front.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/budget/greatest_multiple.h"

namespace assay::budget::pareto_front_test {
namespace {

const Obstacle kTooGreat = {"action_1", "too great"};

// Everything is proved within an ellipse.
std::optional<Obstacle> BeyondTheEllipse(double first, double second) {
  if (std::hypot(first / 3, second / 0.4) < 1) return std::nullopt;
  return kTooGreat;
}

TEST(ParetoFront, LiesOnTheBorderOfWhatIsProved) {
  const std::vector<FrontPoint> front = ParetoFront(BeyondTheEllipse);
  ASSERT_GE(front.size(), 20U);
  for (const FrontPoint& point : front) {
    const auto [first, second] = point.proved;
    EXPECT_FALSE(BeyondTheEllipse(first, second));
    ASSERT_TRUE(point.unproved);
    EXPECT_TRUE(BeyondTheEllipse((*point.unproved)[0], (*point.unproved)[1]));
    EXPECT_NEAR(std::hypot(first / 3, second / 0.4), 1, 0.01);
    EXPECT_EQ(point.obstacle->step, kTooGreat.step);
  }
}

TEST(ParetoFront, GoesFromOneErrorAloneToTheOther) {
  const std::vector<FrontPoint> front = ParetoFront(BeyondTheEllipse);
  EXPECT_EQ(front.front().proved[0], 0);
  EXPECT_NEAR(front.front().proved[1], 0.4, 0.004);
  EXPECT_EQ(front.back().proved[1], 0);
  EXPECT_NEAR(front.back().proved[0], 3, 0.03);
  for (std::size_t i = 1; i < front.size(); ++i) {
    EXPECT_LE(front[i - 1].proved[0], 1.01 * front[i].proved[0]);
    EXPECT_GE(1.01 * front[i - 1].proved[1], front[i].proved[1]);
  }
}

TEST(ParetoFront, MayHaveNoEnd) {
  const std::vector<FrontPoint> front =
      ParetoFront([](double first, double) -> std::optional<Obstacle> {
        if (first < 2) return std::nullopt;
        return kTooGreat;
      });
  EXPECT_EQ(front.front().proved[1], kMostMultiple) << "the second error alone never matters";
  EXPECT_FALSE(front.front().unproved);
  EXPECT_TRUE(front.back().unproved);
}

}  // namespace
}  // namespace assay::budget::pareto_front_test
