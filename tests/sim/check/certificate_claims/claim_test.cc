#include "sim/check/certificate_claims/claim.h"

#include <gtest/gtest.h>

#include <limits>

namespace assay::check::claim_test {
namespace {

Claim Observed(double observed, double gate) {
  return Judged({.step = plan::StepId(0),
                 .name = "x of peg",
                 .dimension = domain::Dimension::kLength,
                 .predicted = {-0.001, 0.002},
                 .observed = observed,
                 .gate = gate});
}

TEST(Claim, IsContainedUpToItsEnds) {
  EXPECT_EQ(Observed(0.002, 0).verdict, ClaimVerdict::kContained);
  EXPECT_EQ(Observed(-0.001, 0).verdict, ClaimVerdict::kContained);
  EXPECT_DOUBLE_EQ(Observed(0.0015, 0).margin, 0.0005);
  EXPECT_DOUBLE_EQ(Observed(-0.0005, 0).margin, 0.0005);
}

TEST(Claim, IsInconclusiveWithinTheGateAndViolatedBeyondIt) {
  EXPECT_EQ(Observed(0.0025, 0.001).verdict, ClaimVerdict::kInconclusive);
  EXPECT_EQ(Observed(0.0035, 0.001).verdict, ClaimVerdict::kViolated);
  EXPECT_EQ(Observed(-0.0025, 0.001).verdict, ClaimVerdict::kViolated);
  EXPECT_EQ(Observed(-0.0011, 0).verdict, ClaimVerdict::kViolated);
}

TEST(Claim, MayBeOpenAtOneEnd) {
  const Claim claim = Judged({.step = plan::StepId(0),
                              .about = Claimed::kPrecondition,
                              .name = "entry",
                              .dimension = domain::Dimension::kLength,
                              .predicted = {0, std::numeric_limits<double>::infinity()},
                              .observed = 0.003});
  EXPECT_EQ(claim.verdict, ClaimVerdict::kContained);
  EXPECT_DOUBLE_EQ(claim.margin, 0.003);
}

TEST(Claim, TheWorstOfAStepIsByVerdictThenByMargin) {
  Claim other_step = Observed(0, 0);
  other_step.step = plan::StepId(1);
  Claim not_claimed = Observed(1, 0);
  not_claimed.verdict = ClaimVerdict::kNotClaimed;
  const auto verdicts = ByStep(
      {Observed(0, 0), Observed(0.0025, 0.001), Observed(0.0015, 0), other_step, not_claimed});
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_EQ(verdicts[0].verdict, ClaimVerdict::kInconclusive);
  EXPECT_DOUBLE_EQ(verdicts[0].worst.observed, 0.0025);
  EXPECT_EQ(verdicts[1].verdict, ClaimVerdict::kContained);
}

}  // namespace
}  // namespace assay::check::claim_test
