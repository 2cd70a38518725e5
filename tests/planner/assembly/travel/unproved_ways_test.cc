#include "planner/assembly/travel/unproved_ways.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/assembly/certified_plan.h"
#include "planner/assembly/travel/travel_check.h"
#include "planner/assembly/travel/way_conditions.h"
#include "planner/plan/certificates/condition_table.h"
#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::assembly::unproved_ways_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

plan::Plan PlanFor(const domain::Problem& problem) {
  return MakeCertifiedPlan(problem, {}, {}).plan;
}

// A mast stands beside the peg. The forearm comes near to it while the hand takes the peg.
TEST(UnprovedWays, NameTheBodiesThatErrorsBringTogether) {
  const domain::Problem problem = constraint_posting::LoadScenario("mast");
  const plan::Plan plan = PlanFor(problem);
  const std::vector<UnprovedWay> ways = UnprovedWays(problem, plan);
  ASSERT_THAT(ways, SizeIs(1));
  EXPECT_EQ(plan.step(ways[0].step).executed, 2);
  EXPECT_EQ(ways[0].condition, plan::Condition(plan::condition::kWayClear));
  EXPECT_THAT(ways[0].why.text, HasSubstr("are nearer than"));
  ASSERT_TRUE(ways[0].why.situation);
  EXPECT_THAT(ways[0].why.situation->colliding, SizeIs(2));
  ASSERT_TRUE(ways[0].share);
  EXPECT_GE(*ways[0].share, 0);
  EXPECT_LT(*ways[0].share, 1);
}

// The block may be farther from its place than proofs of ways take into account.
TEST(UnprovedWays, AreAllWaysBesideAPartThatMayBeFarAway) {
  for (const double shift : {0.04, 0.06}) {
    domain::Problem problem = constraint_posting::LoadScenario("uncertain-known");
    problem.parts[0].error.x = {-shift, shift};
    const plan::Plan plan = PlanFor(problem);
    ASSERT_FALSE(plan.steps.empty());
    const std::vector<UnprovedWay> ways = UnprovedWays(problem, plan);
    const auto is_far = [](const UnprovedWay& way) {
      return way.why.text.find("more than 50 mm from its place") != std::string::npos;
    };
    EXPECT_EQ(std::ranges::any_of(ways, is_far), shift > 0.05) << shift;
    for (const UnprovedWay& way : ways) EXPECT_NE(way.share.has_value(), is_far(way));
  }
}

// In the figures, the leaning hand takes the lying peg after a look at it. Its flange is then near
// the block, and both may be turned by more than 5 degrees.
TEST(UnprovedWays, AreNoneInTheFiguresOfThePaper) {
  for (const char* name : {"spar-fig13", "spar-fig14", "spar-fig15", "spar-fig16", "spar-example",
                           "keyed", "uncertain-known"}) {
    const domain::Problem problem = constraint_posting::LoadScenario(name);
    EXPECT_THAT(UnprovedWays(problem, PlanFor(problem)), IsEmpty()) << name;
  }
}

// A plan for an arm whose solutions cannot be told apart claims nothing about the arm's ways. Such
// a plan is checked with the same errors with which it was made.
TEST(UnprovedWays, AreAllWaysOfAPlanThatClaimsNone) {
  const domain::Problem problem = constraint_posting::LoadScenario("spar-fig15");
  plan::Plan plan = PlanFor(problem);
  ASSERT_THAT(FlawsOfTravels(problem, plan), IsEmpty());
  for (plan::PlannedStep& step : plan.steps) RemoveWayConditions(step.certificate);
  EXPECT_THAT(FlawsOfTravels(problem, plan), IsEmpty());
  plan.steps[0].travel->clearance += 1;
  EXPECT_FALSE(FlawsOfTravels(problem, plan).empty());
}

// Without claims about ways, there is nothing that could be unproved.
TEST(UnprovedWays, AreNoneWithoutCertificates) {
  const domain::Problem problem = constraint_posting::LoadScenario("spar-fig15");
  plan::Plan plan = PlanFor(problem);
  for (plan::PlannedStep& step : plan.steps) step.certificate = {};
  EXPECT_THAT(UnprovedWays(problem, plan), IsEmpty());
}

}  // namespace
}  // namespace assay::assembly::unproved_ways_test
