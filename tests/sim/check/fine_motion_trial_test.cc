#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "planner/assembly/certified_plan.h"
#include "sim/check/falsification/falsification.h"
#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/noise/error_box.h"
#include "sim/noise/sampling.h"
#include "tests/sim/check/certified.h"

// Executions of a plan with an assembly by fine motion. The plan has a look, a pickup that leaves
// the peg off by more than its play, and an insertion by contacts.
namespace assay::check::fine_motion_trial_test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::uint64_t kSeed = 7;

class FeltAssembly : public testing::Test {
 protected:
  static const Certified& certified() {
    static const Certified made = [] {
      Certified felt{domain::ReadProblem(
                         Document::Load(ASSAY_SOURCE_DIR "/scenarios/uncertain-fine-motion.yaml"),
                         ASSAY_SOURCE_DIR "/models"),
                     {}};
      felt.plan = assembly::MakeCertifiedPlan(felt.problem, {}, {}).plan;
      return felt;
    }();
    return made;
  }
  static plan::StepId AssembleStep() { return FirstStep(domain::kAssemble, certified().plan); }

  static const NoiseFloor& Gate() {
    static const NoiseFloor gate = MeasureNoiseFloor(certified().problem, certified().plan, {});
    return gate;
  }

  static Trial Run(const plan::Plan& plan, noise::Mode mode, const NoiseFloor& gate) {
    const Experiment experiment{certified().problem, plan, {}, gate};
    const auto box = noise::ErrorBox(certified().problem, plan);
    return RunTrial(experiment, noise::Sample(certified().problem, box, mode, kSeed, 1),
                    {.sample_rate = 0});
  }
};

// The tests make only one trial, and one falsification with few attempts, because measuring the
// noise floor takes several executions.
TEST_F(FeltAssembly, SeatsThePartInSpiteOfErrors) {
  ASSERT_TRUE(certified().plan.step(AssembleStep()).strategy);
  const Trial trial = Run(certified().plan, noise::Mode::kUniform, Gate());
  EXPECT_EQ(trial.verdict.outcome, TrialOutcome::kSucceeded) << trial.verdict.reason;
  std::set<std::string> claimed;
  for (const Claim& claim : trial.claims) {
    EXPECT_NE(claim.verdict, ClaimVerdict::kViolated)
        << claim.name << " " << claim.observed << " margin " << claim.margin;
    if (claim.step != AssembleStep()) continue;
    EXPECT_NE(claim.verdict, ClaimVerdict::kNotClaimed) << claim.name;
    claimed.insert(claim.name);
  }
  EXPECT_THAT(claimed, Contains("tip shift"));
  EXPECT_THAT(claimed, Contains("tip turn"));
  // The strategy absorbs the precondition `entry`, so this precondition may fail, and it does.
  EXPECT_THAT(claimed, Not(Contains("entry")));
  EXPECT_THAT(claimed, Contains("x of peg"));

  const Experiment experiment{certified().problem, certified().plan, {}, Gate()};
  const FalsificationResult result =
      Falsify(experiment, {.attempts = 3, .seed = kSeed, .shrunk = 0});
  EXPECT_EQ(result.attempts, 3);
  EXPECT_EQ(result.certificates.size(), certified().plan.steps.size());
}

// The first motion leads away from the contact that it should make.
TEST_F(FeltAssembly, AFailureTellsHowTheMatingEnded) {
  plan::Plan plan = certified().plan;
  plan::Strategy& strategy = *plan.steps[AssembleStep().index()].strategy;
  ASSERT_TRUE(strategy.motions[0].until);
  strategy.motions[0].X_FixedTip = strategy.X_FixedStart;
  strategy.motions[0].X_FixedTip.translation() -=
      0.01 * certified().problem.matings[0].mating_vector.normalized();
  const Trial trial = Run(plan, noise::Mode::kNone, {});
  EXPECT_EQ(trial.verdict.outcome, TrialOutcome::kOperatorCalled);
  EXPECT_THAT(trial.trace.end().reason, StartsWith(plan.step(AssembleStep()).name));
  EXPECT_THAT(trial.trace.end().reason, HasSubstr("timeout: motion 1: no contact of"));
  const auto stopped = std::ranges::find(trial.claims, "comes to its end", &Claim::name);
  ASSERT_NE(stopped, trial.claims.end());
  EXPECT_EQ(stopped->verdict, ClaimVerdict::kViolated);
}

}  // namespace
}  // namespace assay::check::fine_motion_trial_test
