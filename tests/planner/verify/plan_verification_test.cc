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

// Changed error sets contradict nothing in the plan, but they differ from those that the scenario
// gives.
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

// A plan with a remedy for what was not proved at first.
struct RemediedPlan {
  std::string scenario;
  std::string resolver;  // of some step
};

class Remedies : public ::testing::TestWithParam<RemediedPlan> {
 protected:
  using Resolutions = std::vector<plan::Resolution>;

  std::vector<plan::Flaw> FlawsAfter(const std::function<void(Resolutions&)>& change) const {
    plan::Plan plan = plan_;
    for (plan::PlannedStep& step : plan.steps) {
      Resolutions& resolutions = step.certificate.resolutions;
      if (std::ranges::count(resolutions, GetParam().resolver, &plan::Resolution::resolver) == 0) {
        continue;
      }
      change(resolutions);
      return Verify({problem_, plan, "plan.json", true}, kOrders).flaws;
    }
    ADD_FAILURE() << "no remedy of this kind";
    return {};
  }
  static plan::Resolution& Of(Resolutions& resolutions) {
    return *std::ranges::find(resolutions, GetParam().resolver, &plan::Resolution::resolver);
  }

  const domain::Problem problem_ = constraint_posting::LoadScenario(GetParam().scenario);
  const plan::Plan plan_ = assembly::MakeCertifiedPlan(problem_, {}, {}).plan;
};

TEST_P(Remedies, AreComparedWithThePlan) {
  const auto refused = Contains(Field(&plan::Flaw::what, HasSubstr("certificate.resolutions: ")));
  EXPECT_THAT(FlawsAfter([](Resolutions&) {}), IsEmpty());
  for (const char* other : {"sensing", "squeezing", "fine-motion", "verification", "magic"}) {
    if (other == GetParam().resolver) continue;
    EXPECT_THAT(FlawsAfter([&](Resolutions& all) { Of(all).resolver = other; }), refused) << other;
  }
  EXPECT_THAT(FlawsAfter([](Resolutions& all) { Of(all).why = "because"; }), refused);
  if (GetParam().resolver == "moving") return;  // why parts were moved is not computed anew
  EXPECT_THAT(FlawsAfter([](Resolutions& all) { Of(all).why.insert(0, "it is "); }), refused);
  EXPECT_THAT(FlawsAfter([](Resolutions& all) { Of(all).steps.clear(), all.clear(); }), refused);
  EXPECT_THAT(FlawsAfter([](Resolutions& all) { all.push_back(all.front()); }), refused);
}

TEST_P(Remedies, AreNotInvented) {
  plan::Plan plan = plan_;
  for (plan::PlannedStep& step : plan.steps) {
    if (!step.certificate.resolutions.empty()) continue;
    step.certificate.resolutions = {{"verification", {}, "not proved that it works"}};
    EXPECT_THAT(Verify({problem_, plan, "plan.json", true}, kOrders).flaws, Not(IsEmpty()));
    return;
  }
}

INSTANTIATE_TEST_SUITE_P(OfScenarios, Remedies,
                         ::testing::Values(RemediedPlan{"uncertain-held", "sensing"},
                                           RemediedPlan{"uncertain-squeezing", "squeezing"},
                                           RemediedPlan{"uncertain-failing", "verification"},
                                           RemediedPlan{"uncertain-clutter", "moving"}),
                         [](const auto& remedied) { return remedied.param.resolver; });

}  // namespace
}  // namespace assay::verify::plan_verification_test
