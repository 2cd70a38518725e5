#include "sim/execution/walk/audit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/geometry/pose.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/execution/walk/tilt_watch.h"
#include "tests/sim/execution/two_cans.h"

namespace assay::execution::audit_test {
namespace {

using geometry::Pose;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

// The initial knowledge state of the two cans, in a simulation that a test changes by hand.
class AuditOfTwoCans : public testing::Test {
 protected:
  explicit AuditOfTwoCans(const Replacements& replacements = {})
      : scenario_(TwoCans(replacements)) {}

  std::vector<FalseClaim> FalseClaims() {
    return audit_.FalseClaims(knowledge_, state_, truth_, readings_, 0);
  }
  void Move(PartId can, const Pose& X_WorldCan) { scene_.SetPart(data_, can, X_WorldCan); }
  Pose Now(PartId can) const { return scene_.TruePose(data_, can); }

  const KnowledgeScenario scenario_;
  const domain::Problem& problem_ = scenario_.scenario.problem;
  const scene::Scene scene_{problem_, {}};
  mujoco::Data data_ = scene_.Start();
  const Truth truth_{problem_, scene_, data_};
  const Audit audit_{scenario_.interpretation, problem_};
  Readings readings_;
  contingent::KnowledgeBase knowledge_{scenario_.interpretation.task};
  contingent::KnowledgeState state_ = knowledge_.Initial();
};

// The init knows that no can is grasped and that none is removed.
TEST_F(AuditOfTwoCans, WhatIsKnownAtFirstIsTrue) {
  EXPECT_THAT(FalseClaims(), IsEmpty());
  EXPECT_FALSE(audit_.IsGoalTrue(truth_));
}

TEST_F(AuditOfTwoCans, WhatTheWorldDoesByItselfIsTold) {
  Move(PartId(1), geometry::Translation(0, 0.8, 0) * Now(PartId(1)));
  EXPECT_THAT(FalseClaims(), ElementsAre(Field(&FalseClaim::atom, "isRemoved(can2)")));
  EXPECT_FALSE(audit_.IsGoalTrue(truth_));
  Move(PartId(0), geometry::Translation(0, 0.8, 0) * Now(PartId(0)));
  EXPECT_THAT(FalseClaims(), UnorderedElementsAre(Field(&FalseClaim::atom, "isRemoved(can1)"),
                                                  Field(&FalseClaim::atom, "isRemoved(can2)")));
  EXPECT_TRUE(audit_.IsGoalTrue(truth_));
}

// At first it is not known whether a can is spillable, so nothing is claimed about this.
TEST_F(AuditOfTwoCans, WhatIsNotKnownIsNotClaimed) {
  for (const bool value : {false, true}) {
    const contingent::KnowledgeState initial = state_;
    const auto& actions = scenario_.interpretation.task.actions;
    const auto sense = std::ranges::find_if(actions, [](const contingent::GroundAction& action) {
      return TextOf(action) == "senseWeight(can1)";
    });
    ASSERT_NE(sense, actions.end());
    state_ = *knowledge_.After(*sense, state_);
    EXPECT_THAT(FalseClaims(), IsEmpty());
    state_ = *knowledge_.Learned(state_, knowledge_.FormulaToBranch(state_), value);
    // By its model, a can weighs at least 0.7 * 120 * 8 * tan(22.5 deg) * 30^2 mm^3 g = 0.25 kg.
    const bool is_true = scene_.TrueMass(PartId(0)) > 0.25;
    EXPECT_EQ(FalseClaims().size(), value == is_true ? 0u : 1u);
    state_ = initial;
  }
}

// Facts of the init that no action changes, so that no query asks about them. The parameters are
// the init and the number of its false claims. Both cans are spillable by their models.
class AuditOfUnchangingFacts : public AuditOfTwoCans,
                               public testing::WithParamInterface<std::pair<const char*, int>> {
 protected:
  AuditOfUnchangingFacts() : AuditOfTwoCans(WithInit(GetParam().first)) {}
};
TEST_P(AuditOfUnchangingFacts, AreHeldAgainstTheSimulator) {
  std::vector<std::string> atoms;
  for (const FalseClaim& claim : FalseClaims()) atoms.push_back(claim.atom);
  const std::vector<std::string> cans = {"isSpillable(can1)", "isSpillable(can2)"};
  EXPECT_EQ(atoms, std::vector<std::string>(cans.begin(), cans.begin() + GetParam().second));
}
INSTANTIATE_TEST_SUITE_P(
    OfSpillable, AuditOfUnchangingFacts,
    testing::Values(std::pair("add(Kf, isSpillable(can1))", 0),
                    std::pair("add(Kf, !isSpillable(can1))", 1),
                    std::pair("add(LCW, isSpillable(?o))", 2),
                    std::pair("add(LCW, isSpillable(?o)), add(Kf, isSpillable(can2))", 1)));

// A relation between unknown atoms. Some of them may have no meaning in the workcell.
struct Related {
  const char* alternatives;
  const char* truth;  // the true literals if the relation does not hold, else empty
  const char* meaning_of_grasped = "{is: held}";
};

class AuditOfRelations : public AuditOfTwoCans, public testing::WithParamInterface<Related> {
 protected:
  AuditOfRelations() : AuditOfTwoCans(Scenario(GetParam())) {}
  static Replacements Scenario(const Related& related) {
    Replacements scenario = WithInit(std::string("add(Kx, ") + related.alternatives + ")");
    scenario.emplace_back("{is: held}", related.meaning_of_grasped);
    return scenario;
  }
};

// In the simulation, both cans are spillable and neither is held.
TEST_P(AuditOfRelations, AreHeldAgainstTheSimulator) {
  const std::string truth = GetParam().truth;
  const std::vector<FalseClaim> claims = FalseClaims();
  ASSERT_EQ(claims.size(), truth.empty() ? 0u : 1u);
  if (truth.empty()) return;
  EXPECT_THAT(claims.front().atom, testing::StartsWith("Kx of "));
  EXPECT_EQ(claims.front().truth, truth);
}
INSTANTIATE_TEST_SUITE_P(OfCans, AuditOfRelations,
                         testing::Values(Related{"isSpillable(can1) | !isSpillable(can2)", ""},
                                         Related{"isSpillable(can1) | isSpillable(can2)",
                                                 "isSpillable(can1) & isSpillable(can2)"},
                                         Related{"some(isSpillable(can1) | isSpillable(can2))", ""},
                                         Related{"some(!isSpillable(can1) | isGrasped(can1))",
                                                 "!isGrasped(can1) & isSpillable(can1)"},
                                         Related{"some(!isSpillable(can1) | isGrasped(can1))", "",
                                                 "{is: internal}"}));

class AuditOfAConjunction : public AuditOfTwoCans {
 protected:
  AuditOfAConjunction()
      : AuditOfTwoCans(WithInit("add(Kw, isSpillable(can1) & !isSpillable(can2))")) {}
};

// Both cans are spillable, so the conjunction is false although its first literal is true. If the
// conjunction is claimed to be true, only the claim about its second literal is false.
TEST_F(AuditOfAConjunction, ClaimsOfItsLiteralsWhatItTellsOfThem) {
  const auto& formulas = scenario_.interpretation.task.formulas;
  const auto sensed = std::ranges::find_if(
      formulas, [](const contingent::Formula& formula) { return formula.literals.size() == 2; });
  ASSERT_NE(sensed, formulas.end());
  const contingent::FormulaId conjunction(static_cast<int>(sensed - formulas.begin()));
  const contingent::KnowledgeState initial = state_;
  state_ = *knowledge_.Learned(initial, conjunction, false);
  EXPECT_THAT(FalseClaims(), IsEmpty());
  state_ = *knowledge_.Learned(initial, conjunction, true);
  EXPECT_THAT(FalseClaims(), ElementsAre(Field(&FalseClaim::atom, "isSpillable(can2)")));
}

TEST_F(AuditOfTwoCans, TheGreatestTiltIsKept) {
  TiltWatch watch(scene_, data_);
  EXPECT_EQ(watch.greatest(PartId(0)), 0);
  const Pose upright = Now(PartId(0));
  for (const double tilt : {0.1, 0.3, 0.2}) {
    Move(PartId(0), upright * geometry::RotationZ(0.7) * geometry::RotationX(tilt));
    watch.Look(data_);
  }
  EXPECT_NEAR(watch.greatest(PartId(0)), 0.3, 1e-9);
  EXPECT_NEAR(watch.greatest(PartId(1)), 0, 1e-9);
}

}  // namespace
}  // namespace assay::execution::audit_test
