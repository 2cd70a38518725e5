#include "planner/assembly/travel/work_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "planner/assembly/certified_plan.h"
#include "planner/assembly/travel/work_lines.h"
#include "planner/domain/problem/problem_file.h"
#include "planner/motion/paths/travel.h"

namespace assay::assembly::work_judge_test {
namespace {

// Returns a figure of Spar in the workcell of another arm.
domain::Problem FigureIn(const std::string& figure, const std::string& workcell) {
  const std::string file = ASSAY_SOURCE_DIR "/scenarios/" + figure + ".yaml";
  const std::string usual = "workcell: puma762-table";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string scenario = text.str();
  scenario.replace(scenario.find(usual), usual.size(), "workcell: " + workcell);
  return domain::ReadProblem(Document::Parse(scenario, file), ASSAY_SOURCE_DIR "/models");
}

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
  const domain::Problem problem = FigureIn("spar-fig13", "ur5e-table");
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
  const domain::Problem problem = FigureIn("spar-fig15", "ur5e-table");
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
