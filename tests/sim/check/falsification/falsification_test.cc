#include "sim/check/falsification/falsification.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "planner/base/stop.h"
#include "sim/check/falsification/conservatism.h"
#include "sim/check/falsification/shrink.h"
#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/noise/sampling.h"
#include "tests/sim/check/certified.h"

namespace assay::check::falsification_test {
namespace {

constexpr std::uint64_t kSeed = 7;

Experiment Of(const Certified& certified) {
  return {certified.problem,
          certified.plan,
          {},
          MeasureNoiseFloor(certified.problem, certified.plan, {})};
}

std::int64_t Violated(const FalsificationResult& result) {
  std::int64_t violated = 0;
  for (const VerdictCounts& counts : result.certificates) violated += counts.violated;
  return violated;
}

// A plan for parts in jigs, with all its preconditions proved.
class Proved : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    certified_ = new Certified(CertifiedPlan("uncertain-known"));
    experiment_ = new Experiment(Of(*certified_));
  }
  static void TearDownTestSuite() {
    delete experiment_;
    delete certified_;
  }
  static inline Certified* certified_ = nullptr;
  static inline Experiment* experiment_ = nullptr;
};

// The next step starts where an attempt at this step ends, so this step must have an attempt first.
TEST_F(Proved, HasAnAttemptAtEachOfTheFirstStepsIfAttemptsAreFew) {
  const std::vector<plan::StepId> order = certified_->plan.ExecutionOrder();
  ASSERT_EQ(order.size(), 2u);
  const FalsificationResult result = Falsify(*experiment_, {.attempts = 1, .seed = kSeed});
  EXPECT_EQ(result.attempts, 1);
  EXPECT_EQ(result.attempts_at[order[0].index()], 1);
  EXPECT_EQ(result.attempts_at[order[1].index()], 0);
}

TEST_F(Proved, IsNotFalsifiedAndSucceedsAtCorners) {
  ASSERT_EQ(certified_->plan.errors, 0);
  const FalsificationResult result = Falsify(*experiment_, {.attempts = 16, .seed = kSeed});
  EXPECT_EQ(result.attempts, 16);
  EXPECT_EQ(Violated(result), 0);
  EXPECT_TRUE(result.counterexamples.empty());
  const auto box = noise::ErrorBox(certified_->problem, certified_->plan);
  for (int number = 1; number <= 2; ++number) {
    const noise::Noise noise =
        noise::Sample(certified_->problem, box, noise::Mode::kVertices, kSeed, number);
    const Trial trial = RunTrial(*experiment_, noise, {.sample_rate = 0});
    EXPECT_EQ(trial.verdict.outcome, TrialOutcome::kSucceeded) << trial.verdict.reason;
    EXPECT_EQ(trial.errors_signalled, 0);
  }
}

TEST_F(Proved, ComesOutTheSameOnTwoThreads) {
  const FalsificationResult one =
      Falsify(*experiment_, {.attempts = 4, .seed = kSeed, .jobs = 1, .shrunk = 0});
  const FalsificationResult two =
      Falsify(*experiment_, {.attempts = 4, .seed = kSeed, .jobs = 2, .shrunk = 0});
  EXPECT_EQ(one.attempts, 4);
  ASSERT_EQ(one.worst.size(), two.worst.size());
  for (std::size_t i = 0; i < one.worst.size(); ++i) {
    EXPECT_EQ(one.worst[i].claim.observed, two.worst[i].claim.observed);
    EXPECT_EQ(one.worst[i].noise.values(), two.worst[i].noise.values());
    EXPECT_EQ(one.worst[i].attempt, two.worst[i].attempt);
  }
}

TEST_F(Proved, MoreNoiseThanIsGuaranteedIsNeededToBreakIt) {
  ConservatismOptions options = {.seed = kSeed, .corners = 1, .greatest = 2, .precision = 0.5};
  options.variables = {{noise::Effect::kHandX}};
  const auto ratios = Conservatism(*experiment_, options);
  ASSERT_EQ(ratios.size(), 1u);
  EXPECT_GE(ratios.front().guaranteed, 1);  // every precondition is proved
  // Nothing broke at up to twice the bounds. There is no ratio, and no guarantee is called false.
  EXPECT_EQ(ratios.front().broken, std::nullopt);
  EXPECT_EQ(ratios.front().ratio(), std::nullopt);
  EXPECT_FALSE(ratios.front().IsFalse());
}

TEST(VariedErrors, AreThoseOfTheirPartOrOfTheHandOrAll) {
  using enum noise::Effect;
  const domain::Problem problem = ScenarioNamed("uncertain-known");
  const domain::PartId first(0);
  const VariedErrors of_part{kPartX, first};
  EXPECT_EQ(NameOf(problem, of_part), "x of " + problem.part(first).name);
  EXPECT_TRUE(of_part.Include(kPartX, first));
  EXPECT_FALSE(of_part.Include(kPartX, domain::PartId(1)));
  EXPECT_FALSE(of_part.Include(kPartYaw, first));
  const VariedErrors of_hand{kHandYaw};
  EXPECT_EQ(NameOf(problem, of_hand), "yaw of the hand");
  EXPECT_FALSE(of_hand.Include(kHandX));
  EXPECT_EQ(NameOf(problem, {}), "all");
  EXPECT_TRUE(VariedErrors().Include(kPadFriction));
}

TEST(ConservatismRatio, IsFalseWhereATrialFailsWithWhatIsGuaranteed) {
  EXPECT_FALSE((ConservatismRatio{.variable = "all", .guaranteed = 2, .broken = 2.5}.IsFalse()));
  EXPECT_TRUE((ConservatismRatio{.variable = "all", .guaranteed = 2, .broken = 2.0}.IsFalse()));
  EXPECT_TRUE((ConservatismRatio{.variable = "all", .guaranteed = 2, .broken = 1.5}.IsFalse()));
  // Nothing about this task is guaranteed, so its failure makes no guarantee false.
  EXPECT_FALSE((ConservatismRatio{.variable = "all", .guaranteed = 0, .broken = 0.1}.IsFalse()));
}

// Spar neglects that the grasped point of a turned part is displaced by its lever arm.
TEST(PaperPropagation, TheMissingLeverArmIsFoundAndShrunk) {
  Certified certified = CertifiedPlan("spar-fig13", {}, uncertainty::Propagation::kPaper);
  certified.plan = UpToThePickup(certified.plan);
  const Experiment experiment = Of(certified);
  const FalsificationResult result =
      Falsify(experiment, {.attempts = 24, .seed = kSeed, .shrunk = 1});
  EXPECT_GT(Violated(result), 0);
  ASSERT_EQ(result.counterexamples.size(), 1u);
  const Counterexample& example = result.counterexamples.front();
  EXPECT_TRUE(example.replayed);
  EXPECT_EQ(example.claim.verdict, ClaimVerdict::kViolated);
  // Few errors are left in the shrunk counterexample. The turn of the part is among them.
  const auto& box = example.noise.box();
  std::size_t left = 0;
  bool turned = false;
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (example.noise.values()[i] == 0) continue;
    ++left;
    turned = turned || box[i].effect == noise::Effect::kPartYaw;
  }
  EXPECT_LE(left, 6u);
  EXPECT_TRUE(turned);
  const auto again = ObserveAgain(experiment, example.claim, example.noise);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->observed, example.claim.observed);
  EXPECT_TRUE(example.is_simplest);

  // If the search for a simpler violation is stopped, the simplest violation that was found so far
  // is kept.
  const auto violated = [](const WorstClaim& worst) { return worst.claim.IsViolated(); };
  const WorstClaim& found = *std::ranges::find_if(result.worst, violated);
  Counterexample cut_short = {.claim = found.claim, .noise = found.noise};
  {
    const std::jthread stop([] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      stop_requested = true;
    });
    EXPECT_THROW(Shrink(experiment, cut_short), Stopped);
  }
  stop_requested = false;
  EXPECT_TRUE(cut_short.claim.IsViolated());
  EXPECT_FALSE(cut_short.is_simplest);
}

}  // namespace
}  // namespace assay::check::falsification_test
