#include "planner/assembly/plan_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "planner/assembly/certified_plan.h"
#include "planner/plan/certificates/condition_table.h"
#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::assembly::plan_check_test {
namespace {

using plan::Strategy;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(PlanCheck, ReplaysStrategies) {
  const domain::Problem problem = constraint_posting::LoadScenario("uncertain-fine-motion");
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  EXPECT_THAT(assembly::Check(problem, plan, 10).flaws, IsEmpty());

  const auto step = static_cast<std::size_t>(
      std::ranges::find_if(plan.steps, [](const auto& s) { return s.strategy.has_value(); }) -
      plan.steps.begin());
  ASSERT_LT(step, plan.steps.size());
  const auto expect = [&](const std::function<void(Strategy&)>& change, const char* words) {
    plan::Plan tampered = plan;
    change(*tampered.steps[step].strategy);
    const std::vector<plan::Flaw> flaws = assembly::Check(problem, tampered, 10).flaws;
    EXPECT_THAT(flaws, Not(IsEmpty())) << words;
    EXPECT_THAT(flaws, Each(AllOf(Field(&plan::Flaw::step, plan::StepId(step)),
                                  Field(&plan::Flaw::what, HasSubstr("the strategy: ")),
                                  Field(&plan::Flaw::what, HasSubstr(words)))));
  };
  expect([](Strategy& s) { s.X_FixedStart.translation().y() += 2e-3; }, "motion ");
  expect([](Strategy& s) { s.certificate.d *= 3; }, "motion ");
  expect([](Strategy& s) { s.certificate.absorbed = 4; }, "motion ");
  expect([](Strategy& s) { s.certificate.absorbs.push_back(plan::condition::kHandClear); },
         "'hand clear'");
}

TEST(PlanCheck, StrategiesAreCertainForTheArmsVelocity) {
  domain::Problem problem = constraint_posting::LoadScenario("uncertain-fine-motion");
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  EXPECT_THAT(FlawsOfStrategies(problem, plan), IsEmpty());
  problem.mating_errors.velocity *= 1.5;
  EXPECT_THAT(FlawsOfStrategies(problem, plan),
              Contains(Field(&plan::Flaw::what, HasSubstr("err by 0.002, and they may by 0.003"))));
}

TEST(PlanCheck, StrategiesCountOnTheGreatestFriction) {
  domain::Problem problem = constraint_posting::LoadScenario("uncertain-fine-motion");
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  problem.tolerances.friction = 0.1;
  EXPECT_THAT(FlawsOfStrategies(problem, plan),
              Contains(Field(&plan::Flaw::what, HasSubstr("at most 0.25, and there may be 0.35"))));
}

// The strategy was found for holes that may be narrower than nominal.
TEST(PlanCheck, TakesTheNarrowestHoles) {
  domain::Problem problem = constraint_posting::LoadScenario("uncertain-fine-motion");
  problem.tolerances.clearance = 0.02e-3;
  const plan::Plan plan = MakeCertifiedPlan(problem, {}, {}).plan;
  ASSERT_TRUE(
      std::ranges::any_of(plan.steps, [](const auto& s) { return s.strategy.has_value(); }));
  EXPECT_THAT(assembly::Check(problem, plan, 10).flaws, IsEmpty());
  problem.tolerances.clearance = 0.2e-3;
  EXPECT_THAT(FlawsOfStrategies(problem, plan), Not(IsEmpty()));
}

}  // namespace
}  // namespace assay::assembly::plan_check_test
