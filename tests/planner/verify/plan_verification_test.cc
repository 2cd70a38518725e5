#include "planner/verify/plan_verification.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "planner/assembly/certified_plan.h"
#include "tests/planner/constraint_posting/scenarios.h"

namespace assay::verify::plan_verification_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr int kOrders = 10;

class PlanVerification : public ::testing::Test {
 protected:
  std::vector<plan::Flaw> FlawsOf(const plan::Plan& plan, bool is_of_file) const {
    return Verify({problem_, plan, "plan.json", is_of_file}, kOrders).flaws;
  }
  plan::Plan Changed(const std::function<void(plan::PlannedStep&)>& change) const {
    plan::Plan plan = plan_;
    change(plan.steps[0]);
    return plan;
  }

  const domain::Problem problem_ = constraint_posting::LoadScenario("uncertain-known");
  const plan::Plan plan_ = assembly::MakeCertifiedPlan(problem_, {}, {}).plan;
};

TEST_F(PlanVerification, APlanAsItWasMadeHoldsUp) {
  ASSERT_THAT(plan_.steps, Not(IsEmpty()));
  EXPECT_THAT(FlawsOf(plan_, true), IsEmpty());
}

// A plan contradicts itself if a bound and its limit do not differ by the margin.
TEST_F(PlanVerification, AContradictionIsFoundWhereverThePlanComesFrom) {
  const plan::Plan plan =
      Changed([](plan::PlannedStep& step) { step.certificate.preconditions[0].margin += 1e-3; });
  for (const bool is_of_file : {false, true}) {
    EXPECT_THAT(FlawsOf(plan, is_of_file), Contains(Field(&plan::Flaw::step, plan::StepId(0))));
  }
}

// Sets contradict nothing in the plan; they differ from what the scenario gives.
TEST_F(PlanVerification, ASetThatDoesNotComeOutIsFoundInAFile) {
  const plan::Plan plan = Changed([](plan::PlannedStep& step) {
    plan::ErrorSet& set = step.certificate.after.at(0);
    set.x.high = set.x.high / 2;
  });
  EXPECT_THAT(FlawsOf(plan, false), IsEmpty());
  EXPECT_THAT(FlawsOf(plan, true),
              Contains(Field(&plan::Flaw::what, HasSubstr("certificate.after[0].x"))));
}

TEST_F(PlanVerification, ActionsThatCannotBeExecutedAreFound) {
  plan::Plan plan = plan_;
  std::ranges::reverse(plan.steps);
  EXPECT_THAT(FlawsOf(plan, false), Not(IsEmpty()));
}

TEST_F(PlanVerification, EachPartIsAnnounced) {
  std::vector<std::string> parts;
  Verify({problem_, plan_, "plan.json", true,
          [&](std::string_view part) { parts.emplace_back(part); }},
         kOrders);
  EXPECT_THAT(parts, ElementsAre("checking the plan", "checking the certificates",
                                 "computing the certificates anew"));
}

}  // namespace
}  // namespace assay::verify::plan_verification_test
