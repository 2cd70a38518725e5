#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "planner/base/input_files/input_error.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/plan_files/plan_file.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/planner/constraint_posting/tip_over.h"

namespace assay::constraint_posting::made_up_action_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// In figure 13 of Spar the block must be turned twice before a peg can be mated with it. A robot
// that can tip it over needs neither of the two regrasps.
class MadeUpAction : public ::testing::Test {
 protected:
  static domain::Problem WithTipOver(domain::Problem problem) {
    problem.actions.push_back(&kTipOver);
    return problem;
  }

  std::vector<std::string> Flaws() const {
    std::vector<std::string> flaws;
    for (const plan::Flaw& flaw : plan::Check(problem_, result_.plan, 100).flaws) {
      flaws.push_back(flaw.what);
    }
    return flaws;
  }

  plan::PlannedStep& TipOver() {
    return *std::ranges::find(result_.plan.steps, &kTipOver,
                              [](const plan::PlannedStep& step) { return step.action.kind; });
  }

  const domain::Problem standard_ = LoadScenario("spar-fig13");
  const domain::Problem problem_ = WithTipOver(standard_);
  plan::PlanResult result_ = MakePlan(problem_, {});
};

TEST_F(MadeUpAction, IsPlanned) {
  ASSERT_EQ(result_.outcome, Outcome::kFound);
  std::vector<std::string_view> names;
  for (const plan::Action& action : ActionsOf(result_.plan)) names.push_back(action.kind->name);
  EXPECT_THAT(names, ElementsAre("tip-over", "pickup", "assemble"));
  EXPECT_EQ(MakePlan(standard_, {}).plan.steps.size(), 6U);
}

TEST_F(MadeUpAction, HasTexts) {
  const plan::Action& action = TipOver().action;
  const std::string expected = "tip-over(block, " + action.place.position + ")";
  EXPECT_EQ(ShortText(problem_, action), expected);
  EXPECT_EQ(FullText(problem_, action), expected);
}

TEST_F(MadeUpAction, IsWrittenAndRead) {
  const std::string text = plan::ToJson(result_, problem_, "figure 13").dump();
  EXPECT_THAT(text, HasSubstr(R"("name":"tip-over","arguments":{"part":"block","position":)"));
  const Document file = Document::Parse(text, "plan.json");
  const plan::Plan read = plan::ReadPlan(file, problem_).plan;
  EXPECT_EQ(ActionsOf(read), ActionsOf(result_.plan));
  EXPECT_THROW(plan::ReadPlan(file, standard_), InputError);
}

TEST_F(MadeUpAction, WorksByTheIndependentChecker) { EXPECT_THAT(Flaws(), IsEmpty()); }

TEST_F(MadeUpAction, LeavesThePartOnTheTable) {
  TipOver().action.place.X_WorldPart.translation().z() += 0.01;
  EXPECT_THAT(Flaws(), Contains(HasSubstr("above the table, not on it")));
}

TEST_F(MadeUpAction, LeavesThePartBesideOthers) {
  const domain::Part& peg = problem_.part(plan::HandledPart(problem_, ActionsOf(result_.plan)[1]));
  plan::Pose& X_WorldBlock = TipOver().action.place.X_WorldPart;
  X_WorldBlock.translation().head<2>() = peg.X_WorldPart.translation().head<2>();
  EXPECT_THAT(Flaws(), Contains(HasSubstr("block overlaps peg")));
}

TEST_F(MadeUpAction, NeedsTheEmptyHand) {
  for (plan::PlannedStep& step : result_.plan.steps) {
    if (step.executed <= 2) step.executed = 3 - step.executed;
  }
  result_.plan.ordering.clear();
  EXPECT_THAT(Flaws(), Contains(HasSubstr("gripper(open) does not hold: the hand holds peg")));
}

}  // namespace
}  // namespace assay::constraint_posting::made_up_action_test
