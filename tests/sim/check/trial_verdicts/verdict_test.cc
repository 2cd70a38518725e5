#include "sim/check/trial_verdicts/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "planner/domain/problem/problem_file.h"
#include "planner/geometry/pose.h"

namespace assay::check::verdict_test {
namespace {

using domain::PartId;
using execution::ExecutionEnd;
using execution::GraspFact;
using execution::RestRecord;
using execution::Trace;
using execution::TrialOutcome;
using geometry::Pose;
using testing::HasSubstr;

// Invented traces of executions, each with one fault.
class JudgeTest : public testing::Test {
 protected:
  JudgeTest()
      : problem_(domain::ReadProblem(Document::Load(ASSAY_SOURCE_DIR "/scenarios/spar-fig15.yaml"),
                                     ASSAY_SOURCE_DIR "/models")),
        mating_(problem_.matings.front()) {
    const domain::Part& fixed = problem_.part(mating_.fixed);
    end_.snapshot.opening = 0.1;
    end_.snapshot.parts.resize(2);
    end_.snapshot.table_heights.resize(2);
    rest_.parts.resize(2);
    Truth(mating_.fixed) = fixed.X_WorldPart;
    Truth(mating_.held) = fixed.X_WorldPart * mating_.X_FixedHeld;
  }

  Pose& Truth(PartId part) { return end_.snapshot.parts[part.index()].truth; }
  void DisplaceHeld(double x, double y, double z) {
    Truth(mating_.held) =
        Truth(mating_.fixed) * geometry::Translation(x, y, z) * mating_.X_FixedHeld;
  }

  Verdict Judged() const {
    return Judge(problem_, {.problem = "test", .parts = {}, .events = {grasp_, rest_, end_}}, {});
  }

  domain::Problem problem_;
  domain::Mating mating_;
  GraspFact grasp_{.time = 4,
                   .part = mating_.held,
                   .expected_width = 0.0762,
                   .opening = 0.0762,
                   .pads_touch = true};
  RestRecord rest_;
  ExecutionEnd end_;
};

// A touch of the arm fails the trial although the goal holds.
TEST_F(JudgeTest, AnArmThatTouchedSomethingHasFailed) {
  const execution::CollisionRecord collision{
      .time = 2.5, .robot = "arm/forearm", .other = "part/brick"};
  const Trace trace = {.problem = "test", .parts = {}, .events = {grasp_, collision, rest_, end_}};
  const Verdict verdict = Judge(problem_, trace, {});
  EXPECT_EQ(verdict.outcome, TrialOutcome::kCollided);
  EXPECT_EQ(Name(verdict.outcome), "collided");
  EXPECT_EQ(verdict.reason, "at 2.50 s arm/forearm touched part/brick");
  EXPECT_FALSE(verdict.findings.empty());
}

TEST_F(JudgeTest, Succeeds) {
  const Verdict verdict = Judged();
  EXPECT_EQ(verdict.outcome, TrialOutcome::kSucceeded);
  EXPECT_EQ(verdict.reason, "");
  EXPECT_EQ(verdict.findings.size(), 10u);
}

TEST_F(JudgeTest, NotSeated) {
  DisplaceHeld(0.02, 0, 0);
  const Verdict verdict = Judged();
  EXPECT_EQ(verdict.outcome, TrialOutcome::kNotSeated);
  EXPECT_EQ(verdict.reason, "seated depth of peg in block: 0.02 m, limit 0.001 m");
}

TEST_F(JudgeTest, Misaligned) {
  DisplaceHeld(0, 0.002, 0);
  EXPECT_EQ(Judged().outcome, TrialOutcome::kMisaligned);
}

// A part that is neither seated nor aligned is reported as not seated.
TEST_F(JudgeTest, NamesTheFirstReason) {
  DisplaceHeld(0.02, 0.002, 0);
  EXPECT_EQ(Judged().outcome, TrialOutcome::kNotSeated);
}

TEST_F(JudgeTest, NotReleased) {
  end_.snapshot.opening = 0.0765;
  EXPECT_EQ(Judged().outcome, TrialOutcome::kNotReleased);
}

TEST_F(JudgeTest, NotReleasedWhileAFingerTouches) {
  end_.snapshot.contacts = {{"gripper/finger_left", "part/peg"}};
  EXPECT_EQ(Judged().outcome, TrialOutcome::kNotReleased);
}

TEST_F(JudgeTest, NotAtRest) {
  rest_.parts[mating_.fixed.index()].linear = 0.01;
  EXPECT_EQ(Judged().outcome, TrialOutcome::kNotAtRest);
}

TEST_F(JudgeTest, GraspFailedExplainsWhyAGoalDoesNotHold) {
  grasp_.opening = 0;
  DisplaceHeld(0.02, 0, 0);
  const Verdict verdict = Judged();
  EXPECT_EQ(verdict.outcome, TrialOutcome::kGraspFailed);
  EXPECT_THAT(verdict.reason, HasSubstr("closed on peg to 0.00 mm instead of 76.20 mm"));
  EXPECT_THAT(verdict.reason, HasSubstr("seated depth"));
}

// Success is judged by where the parts end, and not by how they came there.
TEST_F(JudgeTest, AFailedGraspAloneIsNoFailure) {
  grasp_.opening = 0;
  EXPECT_EQ(Judged().outcome, TrialOutcome::kSucceeded);
}

TEST_F(JudgeTest, ExecutionThatDidNotEndComesFirst) {
  DisplaceHeld(0.02, 0, 0);
  end_.reason = "why";
  for (const TrialOutcome outcome :
       {TrialOutcome::kUnreachable, TrialOutcome::kOverload, TrialOutcome::kEngineWarning}) {
    end_.outcome = outcome;
    EXPECT_EQ(Judged().outcome, outcome);
    EXPECT_EQ(Judged().reason, "why");
  }
}

TEST_F(JudgeTest, NotLocated) {
  problem_.goals = {domain::LocatedGoal{mating_.fixed, {problem_.part(mating_.fixed).resting}}};
  EXPECT_EQ(Judged().outcome, TrialOutcome::kSucceeded);
  Truth(mating_.fixed) = Truth(mating_.fixed) * geometry::RotationY(0.3);
  EXPECT_EQ(Judged().outcome, TrialOutcome::kNotLocated);
}

}  // namespace
}  // namespace assay::check::verdict_test
