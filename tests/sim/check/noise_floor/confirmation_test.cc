#include "sim/check/noise_floor/confirmation.h"

#include <gtest/gtest.h>

namespace assay::check::confirmation_test {
namespace {

// Returns a judged claim that predicts [-1, 1].
Claim Observed(double observed, double gate = 0.1) {
  Claim claim;
  claim.step = plan::StepId(0);
  claim.name = "x";
  claim.dimension = domain::Dimension::kLength;
  claim.predicted = {-1, 1};
  claim.observed = observed;
  claim.gate = gate;
  return Judged(claim);
}

ClaimVerdict VerdictOf(const Claim& coarse, const std::vector<Claim>& finer) {
  return Confirmed({coarse}, [&] { return finer; }).front().verdict;
}

TEST(Confirmation, WhatTheTimestepDoesNotChangeIsViolated) {
  EXPECT_EQ(VerdictOf(Observed(1.5), {Observed(1.5)}), ClaimVerdict::kViolated);
  EXPECT_EQ(VerdictOf(Observed(1.5), {Observed(1.8)}), ClaimVerdict::kViolated);
  EXPECT_EQ(VerdictOf(Observed(-1.5), {Observed(-1.4)}), ClaimVerdict::kViolated);
}

// The true value, at timestep 0, is `at`, and the engine adds c times the timestep. The verdict
// must be that of the true value for every c.
TEST(Confirmation, AnErrorOfFirstOrderInTheTimestepIsToldFromOneOfTheBound) {
  for (const double c : {0.3, 1.0, 1.7}) {
    for (const double side : {-1.0, 1.0}) {
      const auto verdict = [&](double at) {
        return VerdictOf(Observed(side * (at + c)), {Observed(side * (at + c / 2))});
      };
      EXPECT_EQ(verdict(0.9), ClaimVerdict::kContained) << c;
      EXPECT_EQ(verdict(1.05), ClaimVerdict::kInconclusive) << c;
      EXPECT_EQ(verdict(1.2), ClaimVerdict::kViolated) << c;
    }
  }
}

// A part may fall at one timestep and not at the other, which is no error of first order. The
// extrapolated limit must not count as a violation at the other end of the prediction.
TEST(Confirmation, NoLimitIsBeyondTheOtherEnd) {
  EXPECT_EQ(VerdictOf(Observed(100), {Observed(0.5)}), ClaimVerdict::kContained);
  EXPECT_EQ(VerdictOf(Observed(-100), {Observed(1.3)}), ClaimVerdict::kContained);
}

// A value outside of the prediction is a violation even if the execution with half the timestep
// makes no claim about it.
TEST(Confirmation, WhatTheFinerExecutionDoesNotClaimIsViolatedAllTheSame) {
  Claim unclaimed = Observed(1.5);
  unclaimed.verdict = ClaimVerdict::kNotClaimed;
  EXPECT_EQ(VerdictOf(Observed(1.5), {unclaimed}), ClaimVerdict::kViolated);
  unclaimed.observed = 0.5;
  unclaimed.margin = 0.5;
  EXPECT_EQ(VerdictOf(Observed(1.5), {unclaimed}), ClaimVerdict::kContained);
}

TEST(Confirmation, WhatTheFinerExecutionDoesNotComeToIsInconclusiveUnlessItFails) {
  EXPECT_EQ(VerdictOf(Observed(1.5), {}), ClaimVerdict::kInconclusive);
  Claim other = Observed(0.5);
  other.name = "y";
  EXPECT_EQ(VerdictOf(Observed(1.5), {other}), ClaimVerdict::kInconclusive);
  other.verdict = ClaimVerdict::kViolated;
  EXPECT_EQ(VerdictOf(Observed(1.5), {other}), ClaimVerdict::kViolated);
}

TEST(Confirmation, WithoutAViolationNothingIsExecutedAgain) {
  const std::vector<Claim> claims = {Observed(0), Observed(1.05), Observed(-0.5)};
  const auto confirmed = Confirmed(claims, [] {
    ADD_FAILURE();
    return std::vector<Claim>();
  });
  ASSERT_EQ(confirmed.size(), claims.size());
  for (std::size_t i = 0; i < claims.size(); ++i) {
    EXPECT_EQ(confirmed[i].verdict, claims[i].verdict);
    EXPECT_EQ(confirmed[i].gate, claims[i].gate);
  }
}

}  // namespace
}  // namespace assay::check::confirmation_test
