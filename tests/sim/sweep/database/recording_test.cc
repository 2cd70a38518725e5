#include "sim/sweep/database/recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "sim/sweep/database/difference.h"

namespace assay::sweep::recording_test {
namespace {

using check::Claim;
using check::Claimed;
using check::ClaimVerdict;
using check::FalsificationPhase;
using plan::StepId;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

noise::Noise Displaced(double x) { return {{{.name = "dx_peg", .range = {-1, 1}}}, {x}}; }

// The falsification of a plan of two steps. The second step is executed first.
class FalsificationRecording : public ::testing::Test {
 protected:
  FalsificationRecording() {
    plan_.steps.resize(2);
    plan_.steps[0].name = "action_1";
    plan_.steps[1].name = "action_2";
    plan_.steps[0].executed = 2;
    plan_.steps[1].executed = 1;
    result_.attempts = 10;
    result_.certificates = {{.contained = 3, .inconclusive = 1, .violated = 1}, {.contained = 5}};
    result_.claims = {.contained = 20, .inconclusive = 2, .violated = 1, .not_claimed = 4};
    Add(1, Claimed::kBefore, "x of peg", 0.3, {-0.5, 0.5});
    Add(1, Claimed::kPrecondition, "reach", 0.05, {0, kInfinity});
    Add(0, Claimed::kAfter, "y of peg", 0.75, {-0.5, 0.5});
    Add(0, Claimed::kAfter, "x of peg", 0.1, {-0.5, 0.5});
  }

  void Add(int step, Claimed about, const std::string& name, double observed, Interval predicted) {
    const Claim claim = check::Judged({.step = StepId(step),
                                       .about = about,
                                       .name = name,
                                       .dimension = domain::Dimension::kLength,
                                       .predicted = predicted,
                                       .observed = observed,
                                       .gate = 0.01});
    result_.worst.push_back({claim, Displaced(observed), FalsificationPhase::kLocalSearch, 7});
  }
  void AddCounterexample() {
    result_.counterexamples.push_back({.claim = result_.worst[2].claim,
                                       .noise = Displaced(0.5),
                                       .steps = 2,
                                       .replayed = true,
                                       .multiple = 0.25});
  }
  TimedTrial Record(const std::optional<RunCommand>& command = RunCommand{
                        .input = "a.yaml"}) const {
    return Recorded(plan_, {.result = result_,
                            .ratios = ratios_,
                            .run_command = command,
                            .replay_command = "assay replay DB 4"});
  }

  plan::Plan plan_;
  check::FalsificationResult result_;
  std::vector<check::ConservatismRatio> ratios_;
};

TEST_F(FalsificationRecording, IsViolatedWhereACertificateWas) {
  const TimedTrial timed = Record();
  EXPECT_EQ(timed.record.outcome, "violated");
  EXPECT_THAT(timed.record.reason, HasSubstr("step 2 (action_1): y of peg"));
  EXPECT_EQ(timed.record.noise, "dx_peg=0.75");
  EXPECT_EQ(timed.record.counts, (VerdictCounts{8, 1, 1, 0}));
}

// A statement is true or false, so its numbers tell a person nothing.
TEST_F(FalsificationRecording, TellsAViolatedStatementInWords) {
  check::Claim& worst = result_.worst[2].claim;
  worst.name = "comes to its end";
  worst.dimension.reset();
  EXPECT_EQ(Record().record.reason, "step 2 (action_1): comes to its end: it does not");
}

TEST_F(FalsificationRecording, SucceededWhereNoneWas) {
  result_.certificates[0].violated = 0;
  result_.worst.erase(result_.worst.begin() + 2);
  const TimedTrial timed = Record();
  EXPECT_EQ(timed.record.outcome, "succeeded");
  EXPECT_EQ(timed.record.reason, "");
}

// The precondition has one end only. The observed value of the precondition is nearer to this end
// than the observed x of the peg is to either of its two ends.
TEST_F(FalsificationRecording, HasTheWorstClaimOfEachStepInTheOrderOfExecution) {
  const std::vector<VerdictRecord> verdicts = Record().record.verdicts;
  ASSERT_THAT(verdicts, SizeIs(2));
  EXPECT_EQ(verdicts[0],
            (VerdictRecord{1, "action_2", "contained", "reach", 0.05, 0, kInfinity, 0.05, 0.01}));
  EXPECT_EQ(verdicts[1],
            (VerdictRecord{2, "action_1", "violated", "y of peg", 0.75, -0.5, 0.5, -0.25, 0.01}));
}

// A replay prints the unit of each claim, and whether it is claimed before or after its step. It
// takes both from the claims that are kept.
TEST_F(FalsificationRecording, KeepsTheClaimsOfItsVerdictsAtHand) {
  const TimedTrial timed = Record();
  ASSERT_THAT(timed.verdicts, SizeIs(2));
  for (std::size_t i = 0; i < 2; ++i) {
    const check::Claim& worst = timed.verdicts[i].worst;
    EXPECT_EQ(plan_.step(timed.verdicts[i].step).executed, timed.record.verdicts[i].step);
    EXPECT_EQ(worst.name, timed.record.verdicts[i].claim);
    EXPECT_EQ(worst.observed, timed.record.verdicts[i].observed);
    EXPECT_EQ(worst.dimension, domain::Dimension::kLength);
  }
  EXPECT_EQ(timed.verdicts[0].worst.about, Claimed::kPrecondition);
  EXPECT_EQ(timed.verdicts[1].worst.about, Claimed::kAfter);
}

TEST_F(FalsificationRecording, NamesClaimsAsTrialsDo) {
  const TimedTrial timed = Record();
  std::vector<std::string> names;
  for (const WorstClaimRecord& worst : timed.falsification->worst) names.push_back(worst.claim);
  EXPECT_THAT(names, ElementsAre("1/before/x of peg", "1/precondition/reach", "2/after/x of peg",
                                 "2/after/y of peg"));
  EXPECT_EQ(timed.falsification->worst[3],
            (WorstClaimRecord{"2/after/y of peg", 2, "action_1", "after", "y of peg",
                              domain::Dimension::kLength, 0.75, -0.5, 0.5, -0.25, 0.01, "violated",
                              "local-search", 7, "dx_peg=0.75"}));
  EXPECT_EQ(timed.falsification->attempts, 10);
  EXPECT_EQ(timed.falsification->claims, (VerdictCounts{20, 2, 1, 4}));
  EXPECT_THAT(timed.claims, SizeIs(4));
}

TEST_F(FalsificationRecording, CounterexamplesComeWithTheirCommands) {
  AddCounterexample();
  AddCounterexample();
  const std::vector<CounterexampleRecord> examples = Record().falsification->counterexamples;
  ASSERT_THAT(examples, SizeIs(2));
  EXPECT_EQ(examples[1], (CounterexampleRecord{2, "2/after/y of peg", "action_1", "y of peg",
                                               domain::Dimension::kLength, 0.75, -0.5, 0.5, -0.25,
                                               0.01, "dx_peg=0.5", 2, true, 0.25,
                                               "assay run a.yaml --errors 'dx_peg=0.5'"}));
  EXPECT_EQ(Record(std::nullopt).falsification->counterexamples[0].replay, "assay replay DB 4");
}

TEST_F(FalsificationRecording, RatiosAreThereWhereThePlanBroke) {
  ratios_ = {{"x of peg", 2, 5.0}, {"y of peg", 0, 1.0}, {"all", 1, std::nullopt}};
  EXPECT_THAT(Record().falsification->conservatism,
              ElementsAre(ConservatismRecord{"all", 1, std::nullopt, std::nullopt},
                          ConservatismRecord{"x of peg", 2, 5.0, 2.5},
                          ConservatismRecord{"y of peg", 0, 1.0, std::nullopt}));
}

TEST_F(FalsificationRecording, DifferencesAreFoundApartFromCommands) {
  AddCounterexample();
  const FalsificationRecord stored = *Record().falsification;
  EXPECT_THAT(Differences(stored, *Record(RunCommand{.input = "../a.yaml"}).falsification),
              IsEmpty());
  FalsificationRecord other = stored;
  other.worst[0].observed += 1e-15;
  other.attempts = 9;
  EXPECT_THAT(Differences(stored, other),
              ElementsAre("attempts: 10 and 9", HasSubstr("worst 1/before/x of peg")));
}

}  // namespace
}  // namespace assay::sweep::recording_test
