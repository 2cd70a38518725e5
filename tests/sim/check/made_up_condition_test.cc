#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/base/input_files/input_error.h"
#include "planner/constraint_posting/uncertainty_phase/unproved_goals.h"
#include "planner/geometry/pose.h"
#include "planner/plan/certificates/coverage.h"
#include "planner/plan/plan_files/certificate_file.h"
#include "planner/uncertainty/preconditions/certify.h"
#include "sim/check/certificate_claims/certificate_check.h"
#include "tests/sim/check/certified.h"

// A kind of precondition that exists only in this file: hands that take a part are turned about the
// vertical by less than a limit. The file says all that the program must know of a kind: what it
// is, how it is derived, and how it is measured. The tests follow it from the certificate into a
// file and back, through the check of what certificates cover, into a trial, and into the output.
namespace assay::check::made_up_condition_test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using uncertainty::HandWork;
using uncertainty::Precondition;

constexpr double kLimit = 0.5 * std::numbers::pi / 180;  // radians
constexpr char kMeaning[] = "the hand is turned by less than half a degree";

constexpr plan::ConditionKind kHandTurn = {
    .name = "hand turn",
    .meaning = "the hand that takes a part is hardly turned about the vertical",
    .dimension = domain::Dimension::kAngle,
    .needed_by = plan::NeededBy::kGrasp,
    .origin = plan::Origin::kSoundMode};

std::vector<Precondition> HandTurn(const HandWork& work) {
  uncertainty::Preconditions conditions;
  conditions.Within(kHandTurn, kMeaning, work.draw.theta, kLimit);
  return conditions.Take();
}

std::vector<MeasuredMargin> MeasureHandTurn(const MeasuredStep& step) {
  if (step.events().reached == nullptr) return {};
  const execution::TrueAndBelieved& tool = step.events().reached->tool;
  const Eigen::AngleAxisd turn(
      geometry::Matrix3(tool.truth.linear() * tool.believed.linear().transpose()));
  return {{kMeaning, kLimit - turn.angle()}};
}

// The planner's kinds, and this one.
struct Vocabulary {
  Vocabulary() {
    std::ranges::copy(plan::KnownConditions(), std::back_inserter(kinds));
    kinds.push_back(&kHandTurn);
    std::ranges::copy(uncertainty::Theory::KnownDerivations(), std::back_inserter(derivations));
    derivations.push_back({.needed_by = kHandTurn.needed_by,
                           .origin = kHandTurn.origin,
                           .is_of_release = false,
                           .derive = HandTurn});
    measurements.push_back({kHandTurn, MeasureHandTurn});
  }
  uncertainty::Theory theory() const { return {kinds, derivations}; }

  std::vector<const plan::ConditionKind*> kinds;
  std::vector<uncertainty::Derivation> derivations;
  std::vector<Measurement> measurements = KnownMeasurements();
};

bool IsMadeUp(const plan::CertifiedPrecondition& claim) { return claim.condition == kHandTurn; }

class MadeUpCondition : public testing::Test {
 protected:
  MadeUpCondition() : pickup_(FirstStep(domain::kPickup, Original().plan)) {
    for (plan::PlannedStep& step : plan_.steps) step.certificate = {};
  }

  static const Certified& Original() {
    static const Certified certified = CertifiedPlan("uncertain-known");
    return certified;
  }

  // Certifies the steps up to the pickup.
  void Certify(uncertainty::Propagation propagation = uncertainty::Propagation::kSound) {
    uncertainty::UncertainWorld world(problem_, propagation);
    for (const plan::StepId id : plan_.ExecutionOrder()) {
      plan::PlannedStep& step = plan_.steps[id.index()];
      step.certificate =
          CertifyStep(world, step.action, {}, nullptr, vocabulary_.theory()).certificate;
      if (id == pickup_) return;
    }
  }
  const plan::PlannedStep& pickup() const { return plan_.step(pickup_); }
  std::vector<plan::CertifiedPrecondition> MadeUp() const {
    std::vector<plan::CertifiedPrecondition> claims;
    std::ranges::copy_if(pickup().certificate.preconditions, std::back_inserter(claims), IsMadeUp);
    return claims;
  }

  // Returns what is claimed of a pickup by a hand that is turned by an angle (radians).
  std::vector<Claim> ClaimsOfTurned(double angle) const {
    const plan::Action& action = pickup().action;
    execution::Snapshot snapshot;
    const geometry::Pose X_WorldTool = action.place.X_WorldPart * action.hold.X_PartTool;
    snapshot.tool = {X_WorldTool * geometry::RotationZ(angle), X_WorldTool};
    snapshot.opening = problem_.workcell->gripper().max_opening();
    for (const domain::Part& part : problem_.parts) {
      snapshot.parts.push_back({part.X_WorldPart, part.X_WorldPart});
      snapshot.table_heights.push_back(0);
    }
    execution::Trace trace;
    trace.events.push_back(execution::Milestone{pickup_, execution::Stage::kPoised, snapshot});
    trace.events.push_back(execution::Milestone{pickup_, execution::Stage::kReached, snapshot});
    std::vector<Claim> claims = CheckCertificates(problem_, plan_, trace, {}, plan::StepId::None(),
                                                  vocabulary_.measurements);
    std::erase_if(claims, [](const Claim& claim) { return claim.name != kHandTurn.name; });
    return claims;
  }

  Vocabulary vocabulary_;
  domain::Problem problem_ = Original().problem;
  plan::Plan plan_ = Original().plan;
  plan::StepId pickup_;
};

TEST_F(MadeUpCondition, IsDerivedAndCertified) {
  Certify();
  ASSERT_THAT(MadeUp(), SizeIs(2));
  for (const plan::CertifiedPrecondition& claim : MadeUp()) {
    EXPECT_TRUE(claim.holds());
    EXPECT_NEAR(std::abs(claim.bound), problem_.gripper_error.theta.high, 1e-12);
    EXPECT_EQ(std::abs(claim.limit), kLimit);
  }
  problem_.gripper_error.theta = {-2 * kLimit, 2 * kLimit};
  Certify();
  ASSERT_THAT(MadeUp(), SizeIs(2));
  EXPECT_NEAR(MadeUp().front().margin, -kLimit, 1e-12);
}

TEST_F(MadeUpCondition, IsNotDerivedWhereThePaperCounts) {
  Certify(uncertainty::Propagation::kPaper);
  EXPECT_THAT(MadeUp(), IsEmpty());
  EXPECT_THAT(pickup().certificate.not_needed,
              Contains(plan::NotNeeded{kHandTurn, std::string(plan::kNotPublished)}));
}

TEST_F(MadeUpCondition, IsWrittenToAFileAndReadFromIt) {
  Certify();
  const auto json = plan::ToJson(pickup().certificate, problem_, {});
  EXPECT_EQ(json["covers"]["hand turn"], 2);
  const Document file = Document::Parse(json.dump(), "certificate.json");
  const plan::Certificate read =
      plan::ReadCertificate(file.root(), problem_, {}, vocabulary_.kinds);
  EXPECT_EQ(read, pickup().certificate);
  EXPECT_THROW(plan::ReadCertificate(file.root(), problem_, {}), InputError)
      << "the planner does not know it";
}

TEST_F(MadeUpCondition, IsCovered) {
  Certify();
  EXPECT_THAT(FlawsOfCoverage(pickup(), vocabulary_.kinds), IsEmpty());
  EXPECT_THAT(FlawsOfCoverage(pickup()), ElementsAre("'hand turn' is no condition of such a step"));
  plan::PlannedStep lacking = pickup();
  std::erase_if(lacking.certificate.preconditions, IsMadeUp);
  EXPECT_THAT(FlawsOfCoverage(lacking, vocabulary_.kinds),
              ElementsAre("the certificate covers no 'hand turn', which such a step needs"));
}

TEST_F(MadeUpCondition, IsMeasured) {
  Certify();
  const double proved = MadeUp().front().margin;
  for (const double angle : {0.0, 0.1 * kLimit, 0.9 * kLimit, 1.1 * kLimit}) {
    const std::vector<Claim> claims = ClaimsOfTurned(angle);
    ASSERT_THAT(claims, SizeIs(1));
    EXPECT_EQ(claims.front().dimension, domain::Dimension::kAngle);
    EXPECT_NEAR(claims.front().observed, kLimit - angle, 1e-9);
    // Nine tenths of the proved margin must be left.
    EXPECT_EQ(claims.front().IsViolated(), kLimit - angle < 0.9 * proved) << angle;
  }
}

TEST_F(MadeUpCondition, IsShownInDegrees) {
  problem_.gripper_error.theta = {-2 * kLimit, 2 * kLimit};
  Certify();
  EXPECT_EQ(constraint_posting::WhyUnproved(MadeUp().front()),
            "not proved that the hand is turned by less than half a degree: SUP 1, must be < 0.5 "
            "deg");
}

}  // namespace
}  // namespace assay::check::made_up_condition_test
