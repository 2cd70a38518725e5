#include "planner/assembly/travel/work_judge.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/assembly/certified_plan.h"
#include "planner/assembly/travel/work_lines.h"
#include "planner/motion/paths/travel.h"
#include "tests/scenario_in.h"

namespace assay::assembly::work_judge_test {
namespace {

// Returns whether some posture of the arm follows the lines of the action's work. Nothing is in the
// way of this arm.
bool CanFollow(const domain::Problem& problem, const plan::Action& action) {
  const plan::ToolRoute route = plan::RouteOf(problem, action, nullptr, action.place.X_WorldPart);
  const auto postures = motion::PosturesAt(*problem.workcell, route.poised, {});
  return std::ranges::any_of(postures, [&](const kinematics::JointVector& q) {
    return FollowWork(*problem.workcell, route, IsGuarded(action), q).has_value();
  });
}

// The arm cannot execute the first plan. Another one is found.
TEST(WorkJudge, LeadsToAPlanThatTheArmCanExecute) {
  const domain::Problem problem = ScenarioIn("ur5e-table", "spar-fig13");
  const plan::PlanResult result = MakeCertifiedPlan(problem, {}, {});
  ASSERT_EQ(result.outcome, Outcome::kFound);
  WorkJudge judge(problem);
  for (const plan::PlannedStep& step : result.plan.steps) {
    if (plan::HoldIn(step.action) == nullptr) continue;
    if (!plan::FixedPart(problem, step.action).IsNone()) continue;
    EXPECT_TRUE(CanFollow(problem, step.action)) << plan::FullText(problem, step.action);
    EXPECT_TRUE(judge(std::span(&step.action, 1)).objections.empty());
  }
}

// A place out of reach is objected to, and the objection names the part.
TEST(WorkJudge, ObjectsToWorkOutOfReach) {
  const domain::Problem problem = ScenarioIn("ur5e-table", "spar-fig15");
  const plan::PlanResult result = MakeCertifiedPlan(problem, {}, {});
  ASSERT_EQ(result.outcome, Outcome::kFound);
  WorkJudge judge(problem);
  for (const plan::PlannedStep& step : result.plan.steps) {
    if (!step.action.Is(domain::kPickup)) continue;
    plan::Action far = step.action;
    far.place.X_WorldPart.translation().x() += 2;
    const auto judgement = judge(std::span(&far, 1));
    ASSERT_EQ(judgement.objections.size(), 1u);
    EXPECT_EQ(judgement.objections.front().parts, plan::PartsOf(problem, far));
    EXPECT_TRUE(judgement.objections.front().place);
  }
}

}  // namespace
}  // namespace assay::assembly::work_judge_test
