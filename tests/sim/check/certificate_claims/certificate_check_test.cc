#include "sim/check/certificate_claims/certificate_check.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/geometry/pose.h"
#include "planner/plan/certificates/condition_table.h"
#include "tests/sim/execution/figure15.h"

namespace assay::check::certificate_check_test {
namespace {

using domain::PartId;
using execution::Stage;
using geometry::Pose;
using geometry::Vector3;

// A pickup with a certificate made by hand, and invented traces of its execution.
class CertificateCheckTest : public testing::Test {
 protected:
  CertificateCheckTest()
      : problem_(execution::Figure15()),
        plan_(execution::TwoActions(problem_)),
        peg_(execution::PartNamed(problem_, "peg")),
        pickup_(plan_.step(kPickup).action) {
    plan::Certificate& certificate = plan_.steps[kPickup.index()].certificate;
    const Interval wide = {-0.01, 0.01};
    certificate.before = {{.part = peg_, .x = wide, .y = wide, .z = wide, .theta = wide}};
    certificate.after = {{.part = peg_,
                          .in_hand = true,
                          .x = wide,
                          .y = wide,
                          .z = wide,
                          .theta = wide,
                          .tip = wide,
                          .twist = wide}};
    certificate.preconditions = {Precondition(plan::condition::kBetweenFingers, kJustProved)};
    snapshot_.parts.resize(2);
    snapshot_.table_heights.resize(2);
    snapshot_.opening = problem_.workcell->gripper().max_opening();
    snapshot_.tool = {pickup_.place.X_WorldPart * pickup_.hold.X_PartTool,
                      pickup_.place.X_WorldPart * pickup_.hold.X_PartTool};
    for (std::size_t i = 0; i < snapshot_.parts.size(); ++i) {
      const Pose& X_WorldPart = problem_.part(PartId(i)).X_WorldPart;
      snapshot_.parts[i] = {X_WorldPart, X_WorldPart};
    }
    snapshot_.parts[peg_.index()] = {pickup_.place.X_WorldPart, pickup_.place.X_WorldPart};
  }

  static plan::CertifiedPrecondition Precondition(plan::Condition condition, double margin) {
    return {.condition = condition, .margin = margin};
  }
  // Returns the snapshot with the peg displaced by `y_of_tool` metres along the tool's y.
  execution::Snapshot Displaced(double y_of_tool) const {
    execution::Snapshot snapshot = snapshot_;
    Pose& truth = snapshot.parts[peg_.index()].truth;
    truth.translation() += snapshot.tool.truth.linear().col(1) * y_of_tool;
    return snapshot;
  }
  std::vector<Claim> Check(const execution::Snapshot& reached, const execution::Snapshot& end,
                           bool recovered = false) {
    execution::Trace trace;
    trace.events.push_back(execution::Milestone{kPickup, Stage::kPoised, snapshot_});
    trace.events.push_back(execution::Milestone{kPickup, Stage::kReached, reached});
    trace.events.push_back(execution::Milestone{kPickup, Stage::kActed, end});
    if (recovered) {
      trace.events.push_back(
          execution::RecoveryRecord{.time = 0,
                                    .step = kPickup,
                                    .error = "error1",
                                    .strategy = domain::RecoveryStrategy::kRetry});
    }
    trace.events.push_back(execution::StepEnd{kPickup, "action_2", "pickup", end});
    return CheckCertificates(problem_, plan_, trace, {});
  }
  static ClaimVerdict Worst(const std::vector<Claim>& claims) {
    return ByStep(claims).front().verdict;
  }
  static const Claim& Named(const std::vector<Claim>& claims, Claimed about,
                            const std::string& name) {
    return *std::ranges::find_if(
        claims, [&](const Claim& c) { return c.about == about && c.name == name; });
  }

  static constexpr plan::StepId kPickup = plan::StepId(1);
  static constexpr double kJustProved = 1e-15;  // metres
  static constexpr double kRounding = 1.1e-9;   // rounding that the noise floor always forgives
  domain::Problem problem_;
  plan::Plan plan_;
  PartId peg_;
  plan::Action pickup_;
  execution::Snapshot snapshot_;
};

TEST_F(CertificateCheckTest, WithoutErrorsAllIsContained) {
  const std::vector<Claim> claims = Check(snapshot_, snapshot_);
  EXPECT_EQ(claims.size(), 4u + 1u + 6u);
  EXPECT_EQ(Worst(claims), ClaimVerdict::kContained);
}

TEST_F(CertificateCheckTest, APartThatIsElsewhereInTheHandViolatesTheOutputSet) {
  const std::vector<Claim> claims = Check(snapshot_, Displaced(0.012));
  const Claim& y = Named(claims, Claimed::kAfter, "y of peg");
  EXPECT_EQ(y.verdict, ClaimVerdict::kViolated);
  EXPECT_NEAR(y.margin, -0.002, kRounding);
  EXPECT_EQ(Named(claims, Claimed::kAfter, "x of peg").verdict, ClaimVerdict::kContained);
}

// The contacts lie half the part's width from the grasped point, and the pads lie half the opening
// from it.
TEST_F(CertificateCheckTest, ContactsBesideThePadsViolateAProvedPrecondition) {
  const double room = (snapshot_.opening - pickup_.hold.width) / 2;
  const auto between = [&](double y) {
    return Named(Check(Displaced(y), snapshot_), Claimed::kPrecondition, "between fingers");
  };
  EXPECT_NEAR(between(room - 0.001).margin, 0.001, kRounding);
  EXPECT_EQ(between(-room - 0.001).verdict, ClaimVerdict::kViolated);
}

// The observed margin may fall short of the certified one by a tenth of the certified one.
TEST_F(CertificateCheckTest, LessThanTheCertifiedMarginViolatesAProvedPrecondition) {
  problem_.clearance = 1;
  const double room = (snapshot_.opening - pickup_.hold.width) / 2;
  plan_.steps[kPickup.index()].certificate.preconditions = {
      Precondition(plan::condition::kBetweenFingers, 0.002)};
  const auto between = [&](double left) {
    return Named(Check(Displaced(room - left), snapshot_), Claimed::kPrecondition,
                 "between fingers");
  };
  EXPECT_EQ(between(0.0019).verdict, ClaimVerdict::kContained);
  EXPECT_EQ(between(0.0017).verdict, ClaimVerdict::kViolated);
  EXPECT_NEAR(between(0.0017).margin, -0.0001, kRounding);
  // With a clearance less than the certified margin, the observed margin may fall short of the
  // certified one by a tenth of the clearance.
  problem_.clearance = 0.001;
  EXPECT_EQ(between(0.00195).verdict, ClaimVerdict::kContained);
  EXPECT_EQ(between(0.00185).verdict, ClaimVerdict::kViolated);
}

TEST_F(CertificateCheckTest, NothingElseOfTheStepIsClaimedOnceAnUnprovedPreconditionFails) {
  plan_.steps[kPickup.index()].certificate.preconditions = {
      Precondition(plan::condition::kBetweenFingers, 0.002),
      Precondition(plan::condition::kFingerClear, -1)};
  const double width = pickup_.hold.width;
  const std::vector<Claim> failed = Check(Displaced(snapshot_.opening + width), snapshot_);
  EXPECT_EQ(Named(failed, Claimed::kPrecondition, "between fingers").verdict,
            ClaimVerdict::kNotClaimed);
}

TEST_F(CertificateCheckTest, NothingIsClaimedOnceAnUnprovedPreconditionFails) {
  plan_.steps[kPickup.index()].certificate.preconditions = {
      Precondition(plan::condition::kBetweenFingers, -1)};
  const double room = (snapshot_.opening - pickup_.hold.width) / 2;
  const std::vector<Claim> failed = Check(Displaced(room + 0.001), Displaced(0.012));
  EXPECT_EQ(Named(failed, Claimed::kAfter, "y of peg").verdict, ClaimVerdict::kNotClaimed);
  // If the unproved precondition holds in the trial, the rest is claimed.
  const std::vector<Claim> held = Check(snapshot_, Displaced(0.012));
  EXPECT_EQ(Named(held, Claimed::kAfter, "y of peg").verdict, ClaimVerdict::kViolated);
}

// No measurement tells whether the pads hold a part. If the precondition `holding` is not proved,
// it may therefore have failed.
TEST_F(CertificateCheckTest, NothingIsClaimedAfterWhatIsNeitherProvedNorMeasured) {
  auto& preconditions = plan_.steps[kPickup.index()].certificate.preconditions;
  preconditions.push_back(Precondition(plan::condition::kHolding, -1));
  const auto y_of_peg = [&] {
    return Named(Check(snapshot_, Displaced(0.012)), Claimed::kAfter, "y of peg").verdict;
  };
  EXPECT_EQ(y_of_peg(), ClaimVerdict::kNotClaimed);
  preconditions.back().margin = kJustProved;
  EXPECT_EQ(y_of_peg(), ClaimVerdict::kViolated);
}

TEST_F(CertificateCheckTest, NothingIsClaimedAfterARecovery) {
  const std::vector<Claim> claims = Check(snapshot_, Displaced(0.012), true);
  EXPECT_EQ(Named(claims, Claimed::kAfter, "y of peg").verdict, ClaimVerdict::kNotClaimed);
}

TEST_F(CertificateCheckTest, AStepThatIsProvedComesToItsEnd) {
  execution::Trace trace;
  trace.events.push_back(execution::Milestone{kPickup, Stage::kPoised, snapshot_});
  trace.events.push_back(
      execution::ExecutionEnd{execution::TrialOutcome::kOverload, "", snapshot_});
  EXPECT_EQ(Worst(CheckCertificates(problem_, plan_, trace, {})), ClaimVerdict::kViolated);
  trace.events.back() =
      execution::ExecutionEnd{execution::TrialOutcome::kUnreachable, "", snapshot_};
  EXPECT_EQ(Worst(CheckCertificates(problem_, plan_, trace, {})), ClaimVerdict::kContained);
}

TEST_F(CertificateCheckTest, AStepThatIsStoppedOnItsWayIsTheOneThatDoesNotComeToItsEnd) {
  const std::vector<plan::StepId> order = plan_.ExecutionOrder();
  const auto stopped = [&](const execution::Trace& trace, plan::StepId first) {
    const std::vector<Claim> claims = CheckCertificates(problem_, plan_, trace, {}, first);
    const Claim& end = Named(claims, Claimed::kAfter, "comes to its end");
    EXPECT_TRUE(end.IsViolated());
    return end.step;
  };
  execution::Trace trace;
  trace.events.push_back(
      execution::ExecutionEnd{execution::TrialOutcome::kOverload, "", snapshot_});
  EXPECT_EQ(stopped(trace, order[1]), order[1]);
  // Without a first step, the trace is taken to begin with the first step of the plan. After that
  // step has ended, the next step is the one that is stopped.
  EXPECT_EQ(stopped(trace, plan::StepId::None()), order[0]);
  trace.events.insert(trace.events.begin(), execution::StepEnd{order[0], "", "", snapshot_});
  trace.events.insert(trace.events.begin(),
                      execution::Milestone{order[0], Stage::kPoised, snapshot_});
  EXPECT_EQ(stopped(trace, plan::StepId::None()), order[1]);
}

TEST_F(CertificateCheckTest, ACollisionIsAClaimOfTheStepInWhichItHappens) {
  const std::vector<plan::StepId> order = plan_.ExecutionOrder();
  execution::Trace trace;
  trace.events.push_back(execution::Milestone{order[0], Stage::kPoised, snapshot_});
  trace.events.push_back(execution::StepEnd{order[0], "", "", snapshot_});
  trace.events.push_back(execution::CollisionRecord{.time = 0, .robot = "arm", .other = "block"});
  trace.events.push_back(execution::Milestone{order[1], Stage::kPoised, snapshot_});
  trace.events.push_back(execution::StepEnd{order[1], "", "", snapshot_});
  const std::vector<Claim> claims = CheckCertificates(problem_, plan_, trace, {});
  const Claim& clear = Named(claims, Claimed::kAfter, "keeps clear of everything else");
  EXPECT_EQ(clear.step, order[1]);
  EXPECT_TRUE(clear.IsViolated());
}

// The pickup handles the peg alone, so the block must stay where it is.
TEST_F(CertificateCheckTest, APartThatTheStepDoesNotHandleStaysWhereItIs) {
  const std::size_t block = execution::PartNamed(problem_, "block").index();
  const auto shoved = [&](double metres, double radians) {
    execution::Snapshot end = snapshot_;
    end.parts[block].truth.translation().x() += metres;
    end.parts[block].truth.linear() *= geometry::RotationZ(radians).linear();
    return Check(snapshot_, end);
  };
  EXPECT_EQ(Worst(shoved(1e-5, 0)), ClaimVerdict::kContained);
  for (const auto& claims : {shoved(1.3e-4, 0), shoved(0, 2e-3)}) {
    EXPECT_TRUE(Named(claims, Claimed::kAfter, "leaves block where it is").IsViolated());
  }
  plan_.steps[kPickup.index()].certificate.before.push_back(
      {.part = PartId(block), .x = {}, .y = {}, .z = {}, .theta = {}});
  EXPECT_EQ(Worst(shoved(0, 2e-3)), ClaimVerdict::kContained);
}

// A tower may fall before the tool is poised, and shove the block.
TEST_F(CertificateCheckTest, APartStaysWhereItIsOnTheWayToAStepAsWell) {
  const std::size_t block = execution::PartNamed(problem_, "block").index();
  execution::Snapshot before = snapshot_;
  before.parts[block].truth.translation().x() += 1e-3;
  const auto claims_from = [&](const execution::TraceEvent& event) {
    execution::Trace trace;
    trace.events.push_back(event);
    trace.events.push_back(execution::Milestone{kPickup, Stage::kPoised, snapshot_});
    return CheckCertificates(problem_, plan_, trace, {}, kPickup);
  };
  EXPECT_TRUE(Named(claims_from(execution::ExecutionStart{before}), Claimed::kAfter,
                    "leaves block where it is")
                  .IsViolated());
  EXPECT_EQ(Worst(claims_from(execution::ExecutionStart{snapshot_})), ClaimVerdict::kContained);
}

// Each finger has its own bounds. A bound that is proved for one finger is checked even if the
// other finger's bound is not proved. The unproved bound cannot be violated.
TEST_F(CertificateCheckTest, WhatIsProvedIsTestedEvenIfAnotherOfItsNameIsNot) {
  const auto of_contact = [](int contact, bool proved) {
    plan::CertifiedPrecondition claim = Precondition(plan::condition::kBetweenFingers, proved);
    claim.meaning = "contact " + std::to_string(contact) + " lies on the inner side of finger 1";
    return claim;
  };
  const double room = (snapshot_.opening - pickup_.hold.width) / 2;
  for (const int proved : {1, 2}) {
    plan_.steps[kPickup.index()].certificate.preconditions = {of_contact(1, proved == 1),
                                                              of_contact(2, proved == 2)};
    // Finger 1 is the one with the least y. Contact 2 lies on the side of finger 1, and this
    // displacement makes the finger miss it.
    const std::vector<Claim> claims = Check(Displaced(-room - 0.001), snapshot_);
    const Claim& claim = Named(claims, Claimed::kPrecondition, "between fingers");
    EXPECT_EQ(claim.IsViolated(), proved == 2);
    const Claim& other = Named(claims, Claimed::kPrecondition, "between fingers, not proved");
    EXPECT_EQ(other.verdict, ClaimVerdict::kNotClaimed);
    EXPECT_EQ(other.observed < 0, proved == 1);
  }
}

}  // namespace
}  // namespace assay::check::certificate_check_test
