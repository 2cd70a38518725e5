#include <gtest/gtest.h>

#include <cmath>

#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/noise/error_box.h"
#include "sim/noise/sampling.h"
#include "tests/scenario_in.h"
#include "tests/sim/check/certified.h"

namespace assay::check::other_arms_test {
namespace {

class OtherArms : public ::testing::TestWithParam<const char*> {};

// Every execution succeeds and keeps to the certificates, whatever arm executes the plan.
TEST_P(OtherArms, KeepToTheirCertificates) {
  const Certified certified = CertifiedPlan(ScenarioIn(GetParam(), "spar-fig15"));
  EXPECT_EQ(certified.plan.steps.size(), CertifiedPlan("spar-fig15").plan.steps.size());
  const auto box = noise::ErrorBox(certified.problem, certified.plan);
  const NoiseFloor gate = MeasureNoiseFloor(certified.problem, certified.plan, {});
  for (int number = 1; number <= 3; ++number) {
    const noise::Noise noise =
        noise::Sample(certified.problem, box, noise::Mode::kVertices, 31, number);
    const Trial trial =
        RunTrial({.problem = certified.problem, .plan = certified.plan, .gate = gate}, noise, {});
    EXPECT_EQ(trial.verdict.outcome, TrialOutcome::kSucceeded) << trial.verdict.reason;
    EXPECT_GT(trial.claims.size(), 40u);
    for (const Claim& claim : trial.claims) EXPECT_FALSE(claim.IsViolated()) << claim.name;
  }
}

// Two cases of `between fingers` have the same margin here, so rounding decides which one is
// reported. They differ by the width of the part, and the timestep changes neither of them.
TEST(NoiseFloor, ComparesTheSameCasesOfAPrecondition) {
  const Certified certified = CertifiedPlan(ScenarioIn("irb120-table", "mate-square"));
  const NoiseFloor gate = MeasureNoiseFloor(certified.problem, certified.plan, {});
  for (const StepNoiseFloor& step : gate.steps) {
    for (const auto& component : step.components) {
      EXPECT_LT(std::abs(component.step_size), 1e-3) << component.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Workcells, OtherArms,
                         ::testing::Values("ur5e-table", "irb120-table", "kr6-table",
                                           "puma560-table", "iiwa7-table", "ur5e-wsg50"));

}  // namespace
}  // namespace assay::check::other_arms_test
