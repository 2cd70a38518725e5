#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "planner/assembly/certified_plan.h"
#include "planner/geometry/pose.h"
#include "planner/motion/paths/straight_line.h"
#include "sim/execution/commands/action_commands.h"
#include "sim/execution/commands/command_file.h"
#include "sim/execution/commands/run.h"
#include "sim/execution/robots/execution.h"
#include "sim/execution/walk/executor.h"
#include "tests/sim/execution/figure15.h"

namespace assay::execution::planned_travel_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A peg and a block beside a mast, which the forearm hits without planned paths.
class BesideTheMast : public testing::Test {
 protected:
  static const domain::Problem& problem() {
    static const domain::Problem problem = domain::ReadProblem(
        Document::Load(ASSAY_SOURCE_DIR "/scenarios/mast.yaml"), ASSAY_SOURCE_DIR "/models");
    return problem;
  }
  static const plan::Plan& planned() {
    static const plan::Plan plan = assembly::MakeCertifiedPlan(problem(), {}, {}).plan;
    return plan;
  }
  // Returns the plan with the usual travel: up, over at safe height, and down.
  static plan::Plan Usual() {
    plan::Plan plan = planned();
    plan.homing.reset();
    for (plan::PlannedStep& step : plan.steps) step.travel.reset();
    return plan;
  }
  static Trace Executed(const plan::Plan& plan, plan::StepId last = plan::StepId::None()) {
    const scene::Scene scene(problem(), {});
    mujoco::Data data = scene.Start();
    return Execute(problem(), plan, scene, data, {.sample_rate = 200, .last = last});
  }
  // Returns the pairs in which the mast touched the arm, the hand, a finger or the peg.
  static std::set<std::string> TouchedMast(const Trace& trace) {
    std::set<std::string> touched;
    for (const Sample* sample : trace.All<Sample>()) {
      for (const auto& [a, b] : sample->snapshot.contacts) {
        const bool of_mast = a.starts_with("part/mast") || b.starts_with("part/mast");
        if (of_mast && a != "world" && b != "world") touched.insert(a + " " + b);
      }
    }
    return touched;
  }
};

TEST_F(BesideTheMast, TheUsualTravelRunsIntoIt) {
  const plan::StepId pickup = planned().ExecutionOrder()[1];
  EXPECT_THAT(TouchedMast(Executed(Usual(), pickup)), Not(IsEmpty()));
}

TEST_F(BesideTheMast, PlannedPathsTouchNothingAndTheGoalIsReached) {
  const Trace trace = Executed(planned());
  ASSERT_EQ(trace.end().outcome, TrialOutcome::kSucceeded) << trace.end().reason;
  EXPECT_THAT(TouchedMast(trace), IsEmpty());
  const Snapshot& end = trace.end().snapshot;
  for (std::size_t p = 2; p < problem().parts.size(); ++p) {
    const Vector3 moved =
        end.parts[p].truth.translation() - problem().parts[p].X_WorldPart.translation();
    EXPECT_LT(moved.norm(), 1e-4) << problem().parts[p].name;
  }
  const domain::Mating& mating = problem().mating(domain::MatingId(0));
  const Pose X_FixedHeld =
      end.parts[mating.fixed.index()].truth.inverse() * end.parts[mating.held.index()].truth;
  EXPECT_LT((X_FixedHeld.translation() - mating.X_FixedHeld.translation()).norm(), 2e-4);
}

// A path replaces the usual travel, and the step before it ends low.
TEST_F(BesideTheMast, CommandsFollowThePaths) {
  const CommandFile file = CommandFileOf(problem(), planned());
  int paths = 0;
  for (std::size_t i = 0; i < file.steps.size(); ++i) {
    const plan::PlannedStep& step = planned().step(file.steps[i].step);
    for (const Command& command : file.steps[i].approach) {
      EXPECT_EQ(std::holds_alternative<MoveAtSafeHeight>(command) && step.travel, false);
      const auto* follow = std::get_if<FollowPath>(&command);
      if (follow == nullptr) continue;
      EXPECT_EQ(follow->path, step.travel->path);
      if (step.travel->is_usual) continue;
      ++paths;
      if (i == 0 || file.steps[i - 1].depart.empty()) continue;
      const auto& last = std::get<MoveStraight>(file.steps[i - 1].depart.back());
      EXPECT_LT(last.X_WorldTool.translation().z(), problem().workcell->rules().safe_height);
    }
  }
  EXPECT_GT(paths, 0);
}

// A path belongs to one configuration of the arm. It is not followed from a configuration that
// differs by a whole turn or by a flipped wrist.
TEST_F(BesideTheMast, APathIsNotFollowedFromAnotherConfiguration) {
  const scene::Scene scene(problem(), {});
  mujoco::Data data = scene.Start();
  const ExecutorOptions options;
  Execution execution(problem(), scene, data, options);
  kinematics::JointVector turned = problem().workcell->home();
  turned[3] += 2 * M_PI;
  kinematics::JointVector flipped = problem().workcell->home();
  flipped[4] = -flipped[4];
  for (const kinematics::JointVector& away : {turned, flipped}) {
    const FollowPath follow{{away, problem().workcell->home()},
                            plan::HomeTool(*problem().workcell)};
    const Progress failure = execution::Run(follow, {}, execution);
    ASSERT_TRUE(failure);
    EXPECT_EQ(failure->outcome, TrialOutcome::kUnreachable);
    EXPECT_THAT(failure->reason, HasSubstr("not in the configuration"));
  }
}

// The motion begins where the tool is and ends at the commanded pose of the tool, although errors
// displace both from the planned path.
TEST_F(BesideTheMast, APathBeginsAndEndsWhereTheToolIs) {
  const scene::Scene scene(problem(), {});
  mujoco::Data data = scene.Start();
  const ExecutorOptions options;
  Execution execution(problem(), scene, data, options);
  const domain::Workcell& workcell = *problem().workcell;
  const kinematics::JointVector home = workcell.home();
  kinematics::JointVector start = home;
  start.array() += 0.05;
  kinematics::JointVector end = home;
  end[0] += 0.3;
  const Pose X_WorldTool = geometry::Translation(0.004, -0.003, 0.002) *
                           motion::ToolAt(workcell, end) * geometry::RotationZ(0.05);
  const FollowPath follow{{start, end}, X_WorldTool};
  ASSERT_FALSE(execution::Run(follow, {}, execution));
  EXPECT_TRUE(execution.BelievedTool().isApprox(X_WorldTool, 1e-6));
  EXPECT_LT((execution.commanded() - end).cwiseAbs().maxCoeff(), 0.2);
}

}  // namespace
}  // namespace assay::execution::planned_travel_test
