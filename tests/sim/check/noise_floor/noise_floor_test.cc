#include "sim/check/noise_floor/noise_floor.h"

#include <gtest/gtest.h>

#include <limits>

#include "sim/check/falsification/falsification.h"
#include "sim/check/noise_floor/measure_noise_floor.h"
#include "tests/sim/check/certified.h"

namespace assay::check::noise_floor_test {
namespace {

using domain::Dimension;

constexpr double kRounding = 1e-9;      // added to every prediction
constexpr double kMicrometre = 1e-6;    // no length is resolved any better
constexpr double kMicroradians = 1e-5;  // no angle is resolved any better

// Returns a noise floor in which penetration turns a part by 1e-4 radians, and in which every
// figure differs from the others of its unit.
NoiseFloor Gate() {
  return {{{.components = {{Claimed::kAfter, "x of peg", 5e-5, 2e-5},
                           {Claimed::kAfter, "theta of peg", 0, -3e-3},
                           {Claimed::kPrecondition, "tilt", 0, -4e-3}},
            .arm = 0.01,
            .penetration = 1e-6,
            .lag = 2e-6,
            .lag_turn = 5e-5}}};
}

Claim Of(const char* name, std::optional<Dimension> dimension, Interval predicted,
         Claimed about = Claimed::kAfter) {
  return {.step = plan::StepId(0),
          .about = about,
          .name = name,
          .dimension = dimension,
          .predicted = predicted};
}

TEST(NoiseFloor, WhatTheTimestepDoesIsKnownOnItsSideOnly) {
  const Claim x = Gate().Passed(Of("x of peg", Dimension::kLength, {-1e-3, 1e-3}));
  EXPECT_NEAR(x.predicted.low, -1e-3 - 3e-6, 2 * kRounding);
  EXPECT_NEAR(x.predicted.high, 1e-3 + 3e-6 + 2e-5, 2 * kRounding);
  EXPECT_DOUBLE_EQ(x.gate, 2e-5 + kMicrometre);
  const Claim theta = Gate().Passed(Of("theta of peg", Dimension::kAngle, {-0.1, 0.1}));
  EXPECT_NEAR(theta.predicted.low, -0.1 - 1.5e-4 - 3e-3, 2 * kRounding);
  EXPECT_NEAR(theta.predicted.high, 0.1 + 1.5e-4, 2 * kRounding);
  EXPECT_DOUBLE_EQ(theta.gate, 3e-3 + kMicroradians);
}

// If a length has no gate of its own, it gets no gate from angles or from other lengths, however
// great their gates are.
TEST(NoiseFloor, GatesOfOtherClaimsAndUnitsAreNotTaken) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Claim landing = Gate().Passed(
      Of("landing height", Dimension::kLength, {0, kInfinity}, Claimed::kPrecondition));
  EXPECT_NEAR(landing.predicted.low, -3e-6, 2 * kRounding);
  EXPECT_EQ(landing.predicted.high, kInfinity);
  EXPECT_EQ(landing.gate, kMicrometre);
  // A claim about another time has another noise floor, although its name is the same.
  EXPECT_EQ(Gate().Passed(Of("x of peg", Dimension::kLength, {0, 0}, Claimed::kBefore)).gate,
            kMicrometre);
  const Claim end = Gate().Passed(Of("comes to its end", std::nullopt, {1, 1}));
  EXPECT_EQ(end.predicted, (Interval{1, 1}));
}

TEST(NoiseFloor, RoundingIsAlwaysForgivenAndAMicrometreMeansNothing) {
  Claim claim = Of("x of peg", Dimension::kLength, {-1e-3, 1e-3}, Claimed::kBefore);
  claim.observed = 1e-3 + 1e-12;
  EXPECT_EQ(Judged(NoiseFloor().Passed(claim)).verdict, ClaimVerdict::kContained);
  claim.observed = 1e-3 + 0.9 * kMicrometre;
  EXPECT_EQ(Judged(NoiseFloor().Passed(claim)).verdict, ClaimVerdict::kInconclusive);
  claim.observed = 1e-3 + 1.1 * kMicrometre;
  EXPECT_EQ(Judged(NoiseFloor().Passed(claim)).verdict, ClaimVerdict::kViolated);
}

// Contacts that are not equally deep turn a part by 1e-6 / 0.02 radians, and the hand's lag by 5e-5
// more. An origin half a metre away from the body moves by half a metre times that.
TEST(NoiseFloor, ATiltMovesAnOriginThatIsFarFromItsBody) {
  Claim z = Of("z of peg", Dimension::kLength, {-1e-3, 1e-3});
  z.lever = {.length = 0.5, .arm = 0.02};
  EXPECT_NEAR(Gate().Passed(z).predicted.high, 1e-3 + 3e-6 + 0.5 * 1e-4, 2 * kRounding);
  EXPECT_NEAR(Gate().Passed(z).predicted.low, -1e-3 - 3e-6 - 0.5 * 1e-4, 2 * kRounding);
  z.lever.length = 0;
  EXPECT_NEAR(Gate().Passed(z).predicted.high, 1e-3 + 3e-6, 2 * kRounding);
}

// The floor of `x of peg` is 45 micrometres, and that of the tilt is 8.17 mrad.
TEST(NoiseFloor, HidesWhatIsNarrowerThanItsFloor) {
  const NoiseFloor gate = Gate();
  const auto hides = [&](Claim claim, double clearance) {
    return gate.Hides(gate.Passed(std::move(claim)), clearance);
  };
  EXPECT_NEAR(gate.Floor(Of("x of peg", Dimension::kLength, {})), 45e-6, 2 * kRounding);
  EXPECT_FALSE(hides(Of("x of peg", Dimension::kLength, {-23e-6, 23e-6}), 1e-6));
  EXPECT_TRUE(hides(Of("x of peg", Dimension::kLength, {-22e-6, 22e-6}), 1));
  // Penetration and lag add 3 micrometres at each end, and the engine's resolution adds one more. A
  // set that is narrower than 8 micrometres is compared with the clearance, and a wider one with
  // the floor.
  EXPECT_FALSE(hides(Of("x of peg", Dimension::kLength, {-3.9e-6, 3.9e-6}), 46e-6));
  EXPECT_TRUE(hides(Of("x of peg", Dimension::kLength, {-3.9e-6, 3.9e-6}), 44e-6));
  EXPECT_TRUE(hides(Of("x of peg", Dimension::kLength, {-4.1e-6, 4.1e-6}), 1));
  // A claim without a width is compared with the clearance. An angle is compared with the clearance
  // over the arm.
  EXPECT_FALSE(hides(Of("x of peg", Dimension::kLength, {0, 0}), 46e-6));
  EXPECT_TRUE(hides(Of("x of peg", Dimension::kLength, {0, 0}), 44e-6));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Claim tilt = Of("tilt", Dimension::kAngle, {0, kInfinity}, Claimed::kPrecondition);
  EXPECT_FALSE(hides(tilt, 8.2e-5));
  EXPECT_TRUE(hides(tilt, 8.1e-5));
}

// Without noise the fixed part creeps by 4 micrometres.
TEST(NoiseFloor, ThePartThatAMatingLeavesInItsPlaceMayCreepAsWithoutNoise) {
  NoiseFloor gate = Gate();
  gate.steps[0].components.push_back({Claimed::kBefore, "x of block", 1e-6, 0});
  gate.steps[0].components.push_back({Claimed::kAfter, "x of block", -3e-6, 0});
  Claim x = Of("x of block", Dimension::kLength, {-1e-3, 1e-3});
  EXPECT_NEAR(gate.Passed(x).predicted.high, 1e-3 + 3e-6, 2 * kRounding);
  x.is_of_fixed = true;
  EXPECT_NEAR(gate.Passed(x).predicted.low, -1e-3 - 3e-6 - 4e-6, 2 * kRounding);
  EXPECT_NEAR(gate.Passed(x).predicted.high, 1e-3 + 3e-6 + 4e-6, 2 * kRounding);
  // A part that moves by more than 20 micrometres does not only creep.
  gate.steps[0].components.back().offset = 0.1;
  EXPECT_NEAR(gate.Passed(x).predicted.high, 1e-3 + 3e-6 + 20e-6, 2 * kRounding);
  x.about = Claimed::kBefore;
  EXPECT_NEAR(gate.Passed(x).predicted.high, 1e-3 + 3e-6, 2 * kRounding);
}

class WithoutNoise : public testing::Test {
 protected:
  WithoutNoise() {
    certified_.plan = UpToThePickup(certified_.plan);
    pickup_ = FirstStep(domain::kPickup, certified_.plan);
  }
  NoiseFloor Measured() const { return MeasureNoiseFloor(certified_.problem, certified_.plan, {}); }
  FalsificationResult Falsified(const NoiseFloor& floor) const {
    const Experiment experiment = {certified_.problem, certified_.plan, {}, floor};
    return Falsify(experiment, {.attempts = 1, .shrunk = 1});
  }
  plan::ErrorSet& InHand() {
    return certified_.plan.steps[pickup_.index()].certificate.after.front();
  }

  Certified certified_ = CertifiedPlan("uncertain-known");
  plan::StepId pickup_;
};

// The part is where the plan puts it, but the certificate says that it is a millimetre or more
// away. The offset of 1 mm in the execution without noise does not widen the gate of that claim.
TEST_F(WithoutNoise, APlanThatLeavesItsOwnCertificateIsViolatedBeforeAnythingIsTried) {
  InHand().x = {0.001, 0.002};
  const FalsificationResult result = Falsified(Measured());
  EXPECT_EQ(result.attempts, 0);
  ASSERT_EQ(result.noiseless.violated.size(), 1u);
  EXPECT_EQ(result.noiseless.violated.front().name, "x of peg");
  EXPECT_EQ(result.certificates[pickup_.index()].violated, 1);
  ASSERT_EQ(result.counterexamples.size(), 1u);
  for (const double value : result.counterexamples.front().noise.values()) EXPECT_EQ(value, 0);
}

// The twist depends on the timestep, and the predicted set has nine tenths of the width of the
// twist's noise floor. It cannot be tested, and the falsification reports it as hidden.
TEST_F(WithoutNoise, ASetThatTheEngineDoesNotResolveIsToldBeforeAnythingIsTried) {
  NoiseFloor floor = Measured();
  Claim twist = Of("twist of peg", Dimension::kAngle, {});
  twist.step = pickup_;
  for (ClaimNoiseFloor& component : floor.steps[pickup_.index()].components) {
    if (component.about == twist.about && component.name == twist.name) component.step_size = 1e-3;
  }
  const double half = 0.45 * floor.Floor(twist);
  ASSERT_GT(half, 0.9e-3);
  InHand().twist = {-half, half};
  const FalsificationResult result = Falsified(floor);
  EXPECT_EQ(result.attempts, 0);
  EXPECT_TRUE(result.noiseless.violated.empty());
  ASSERT_EQ(result.noiseless.hidden.size(), 1u);
  EXPECT_EQ(result.noiseless.hidden.front().name, "twist of peg");
}

}  // namespace
}  // namespace assay::check::noise_floor_test
