#include "sim/check/confirmation.h"

#include <gtest/gtest.h>

namespace assay::check::confirmation_test {
namespace {

// In [-1, 1], judged.
Claim Observed(double observed, double gate = 0.1) {
  Claim claim;
  claim.step = plan::StepId(0);
  claim.name = "x";
  claim.unit = "m";
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

// A bound that holds, and an error of the engine that is c times the timestep: whatever c is, the
// verdict is not a violation; and a violation by more than the gate is one in spite of it.
TEST(Confirmation, AnErrorOfFirstOrderInTheTimestepIsToldFromOneOfTheBound) {
  for (const double c : {0.2, 1.0, 5.0}) {
    EXPECT_EQ(VerdictOf(Observed(1 + c), {Observed(1 + c / 2)}), ClaimVerdict::kInconclusive);
    EXPECT_EQ(VerdictOf(Observed(-1 - c), {Observed(-1 - c / 2)}), ClaimVerdict::kInconclusive);
    EXPECT_EQ(VerdictOf(Observed(1.2 + c), {Observed(1.2 + c / 2)}), ClaimVerdict::kViolated);
  }
}

TEST(Confirmation, WhatIsNotClaimedAnyMoreIsInconclusive) {
  EXPECT_EQ(VerdictOf(Observed(1.5), {}), ClaimVerdict::kInconclusive);
  Claim other = Observed(1.5);
  other.name = "y";
  EXPECT_EQ(VerdictOf(Observed(1.5), {other}), ClaimVerdict::kInconclusive);
  Claim unclaimed = Observed(1.5);
  unclaimed.verdict = ClaimVerdict::kNotClaimed;
  EXPECT_EQ(VerdictOf(Observed(1.5), {unclaimed}), ClaimVerdict::kInconclusive);
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
