#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/noise/error_box.h"
#include "sim/noise/sampling.h"
#include "tests/sim/check/certified.h"

namespace assay::check::other_arms_test {
namespace {

// Returns figure 15 of Spar with another workcell, whose arm is not like the Puma.
domain::Problem Figure15In(const std::string& workcell) {
  const std::string file = ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml";
  const std::string usual = "workcell: puma762-table";
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::string scenario = text.str();
  scenario.replace(scenario.find(usual), usual.size(), "workcell: " + workcell);
  return domain::ReadProblem(Document::Parse(scenario, file), ASSAY_SOURCE_DIR "/models");
}

class OtherArms : public ::testing::TestWithParam<const char*> {};

// Every execution succeeds and keeps to the certificates, whatever arm executes the plan.
TEST_P(OtherArms, KeepToTheirCertificates) {
  const Certified certified = CertifiedPlan(Figure15In(GetParam()));
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

INSTANTIATE_TEST_SUITE_P(Workcells, OtherArms,
                         ::testing::Values("ur5e-table", "irb120-table", "kr6-table"));

}  // namespace
}  // namespace assay::check::other_arms_test
