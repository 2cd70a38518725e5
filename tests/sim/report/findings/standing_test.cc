#include "sim/report/findings/standing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "planner/base/random.h"
#include "sim/check/noise_floor/confirmation.h"

namespace assay::report::standing_test {
namespace {

using check::Claim;
using check::ClaimVerdict;

Claim Observed(double observed, double gate) {
  Claim claim{.step = plan::StepId(0), .name = "x", .predicted = {-1, 1}, .observed = observed};
  claim.gate = gate;
  return check::Judged(claim);
}

Standing Told(const Claim& claim) {
  return StandingOf(StoredVerdict{check::Name(claim.verdict), claim.margin, claim.gate});
}

// An observation inside the prediction is contained. Outside by less than the gate, it is within
// the engine's resolution. Farther outside it is violated.
TEST(Standing, IsWithinResolutionExactlyWithinTheGate) {
  RandomStream random(1, "standing");
  for (int i = 0; i < 1000; ++i) {
    const double observed = random.Uniform(-3, 3);
    const double gate = random.Uniform(0, 1);
    const double outside = std::abs(observed) - 1;
    const Standing standing = Told(Observed(observed, gate));
    EXPECT_EQ(standing, outside <= 0     ? Standing::kContained
                        : outside < gate ? Standing::kWithinResolution
                                         : Standing::kViolated)
        << observed << ", gate " << gate;
  }
}

// A violation that the finer execution does not observe is inconclusive, whatever its size.
TEST(Standing, WhatIsNotConfirmedIsInconclusive) {
  RandomStream random(2, "standing");
  for (int i = 0; i < 1000; ++i) {
    const Claim violated = Observed(random.Uniform(1.6, 3), random.Uniform(0, 0.5));
    ASSERT_TRUE(violated.IsViolated());
    const Claim told = check::Confirmed({violated}, [] { return std::vector<Claim>{}; }).front();
    EXPECT_EQ(told.verdict, ClaimVerdict::kInconclusive);
    EXPECT_EQ(Told(told), Standing::kInconclusive);
  }
}

TEST(Standing, EveryOneHasNameWordsAndCount) {
  std::set<std::string> names;
  StandingCounts counts;
  std::int64_t sum = 0;
  for (const Standing standing : kStandings) {
    names.emplace(Name(standing));
    names.emplace(TextOf(standing));
    counts.Add(standing, ++sum);
    EXPECT_EQ(counts.Of(standing), sum);
  }
  // The words of two standings differ from their names.
  EXPECT_EQ(names.size(), kStandings.size() + 2);
  counts += counts;
  EXPECT_EQ(counts.Total(), 2 * (1 + 2 + 3 + 4 + 5));
  const check::VerdictCounts expected{
      .contained = 2, .inconclusive = 4 + 6, .violated = 8, .not_claimed = 10};
  EXPECT_EQ(counts.Verdicts(), expected);
}

}  // namespace
}  // namespace assay::report::standing_test
