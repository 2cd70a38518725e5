#include "planner/budget/greatest_multiple.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/assembly/certified_plan.h"
#include "planner/budget/error_quantity.h"
#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::budget::greatest_multiple_test {
namespace {

ObstacleAt From(double multiple) {
  return [multiple](double at) -> std::optional<Obstacle> {
    if (at < multiple) return std::nullopt;
    return Obstacle{"action_1", "too great"};
  };
}

TEST(GreatestMultiple, IsWithinAHundredthOfWhereProofsEnd) {
  for (const double end : {0.02, 0.3, 0.999, 1.0, 1.001, 3.7, 63.0}) {
    const GreatestMultiple found = FindGreatestMultiple(From(end));
    EXPECT_LT(found.proved, end);
    EXPECT_GE(1.01 * found.proved, end);
    ASSERT_TRUE(found.unproved);
    EXPECT_DOUBLE_EQ(*found.unproved, 1.01 * found.proved);
    ASSERT_TRUE(found.obstacle);
    EXPECT_EQ(found.obstacle->step, "action_1");
  }
}

TEST(GreatestMultiple, MayHaveNoEndOrNoStart) {
  const GreatestMultiple endless = FindGreatestMultiple(From(1e9));
  EXPECT_EQ(endless.proved, kMostMultiple);
  EXPECT_FALSE(endless.unproved);
  EXPECT_FALSE(endless.obstacle);
  const GreatestMultiple none = FindGreatestMultiple(From(0));
  EXPECT_EQ(none.proved, 0);
  EXPECT_TRUE(none.obstacle);
}

// The certificates of the same plan, computed by the planner, prove the same.
TEST(GreatestMultiple, OfAPlanIsProvedAndALittleMoreIsNot) {
  const domain::Problem problem = constraint_posting::LoadScenario("uncertain-known");
  const plan::PlanResult planned = assembly::MakeCertifiedPlan(problem, {}, {});
  ASSERT_EQ(planned.outcome, Outcome::kFound);
  const auto obstacle_at = [&](double multiple) {
    return ObstacleOfPlan(WithErrorsTimes(problem, multiple), planned.plan);
  };
  const GreatestMultiple found = FindGreatestMultiple(obstacle_at);
  EXPECT_GT(found.proved, 1) << "the scenario is proved as it is";
  ASSERT_TRUE(found.unproved);
  EXPECT_FALSE(obstacle_at(found.proved));
  EXPECT_TRUE(obstacle_at(*found.unproved));
  EXPECT_FALSE(obstacle_at(0.5 * found.proved)) << "smaller errors are no harder to prove";
}

}  // namespace
}  // namespace assay::budget::greatest_multiple_test
