#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/assembly/certified_plan.h"
#include "planner/domain/problem/problem_file.h"
#include "sim/check/trial_verdicts/verdict.h"
#include "sim/execution/walk/executor.h"

namespace assay::check::collided_trial_test {
namespace {

using testing::HasSubstr;

// The plan is executed beside the mast with the usual travel: up, over at safe height, and down.
// The forearm runs into the mast. A collision fails the trial, whatever became of peg and block.
TEST(CollidedTrial, AForearmThatRunsIntoTheMastHasFailed) {
  const domain::Problem problem = domain::ReadProblem(
      Document::Load(ASSAY_SOURCE_DIR "/scenarios/mast.yaml"), ASSAY_SOURCE_DIR "/models");
  plan::Plan plan = assembly::MakeCertifiedPlan(problem, {}, {}).plan;
  plan.homing.reset();
  for (plan::PlannedStep& step : plan.steps) step.travel.reset();
  const scene::Scene scene(problem, {});
  mujoco::Data data = scene.Start();
  const plan::StepId pickup = plan.ExecutionOrder()[1];
  const execution::Trace trace =
      execution::Execute(problem, plan, scene, data, {.sample_rate = 0, .last = pickup});

  const Verdict verdict = Judge(problem, trace, {});
  EXPECT_EQ(verdict.outcome, TrialOutcome::kCollided);
  EXPECT_THAT(verdict.reason, HasSubstr("arm/forearm touched part/mast"));
}

}  // namespace
}  // namespace assay::check::collided_trial_test
