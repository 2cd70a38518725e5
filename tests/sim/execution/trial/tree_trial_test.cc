#include "sim/execution/trial/tree_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "sim/execution/interpretation/knowledge_scenario.h"
#include "tests/sim/execution/two_cans.h"

namespace assay::execution::tree_trial_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kSpillable = 0.25;  // kg
const HiddenWorld kOneFull = {{{PartId(0), 0.42}, {PartId(1), 0.1}}};
const HiddenWorld kBothFull = {{{PartId(0), 0.42}, {PartId(1), 0.45}}};

void ExpectSame(const TreeTrial& a, const TreeTrial& b) {
  EXPECT_EQ(a.duration, b.duration);
  EXPECT_EQ(a.greatest_tilt, b.greatest_tilt);
  EXPECT_EQ(a.walk.branches, b.walk.branches);
}

// The tree is the paper's. The weights of the cans decide which leaf is reached, so every leaf has
// its world.
TEST(TreeTrials, EveryLeafOfTwoCansIsReached) {
  const KnowledgeScenario scenario = TwoCans();
  const contingent::PlanTree tree = TreeOf(scenario);
  const std::vector<Leaf> leaves = LeavesOf(scenario.interpretation.task, tree, 100);
  ASSERT_EQ(leaves.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    RandomStream random(1, "worlds");
    const auto world =
        WorldFor(leaves[i], scenario.interpretation, scenario.scenario.problem, random);
    ASSERT_TRUE(world);
    const TreeTrial trial = RunTrial(scenario, tree, {i + 1, *world}, {});
    EXPECT_EQ(trial.outcome, TrialOutcome::kSucceeded) << trial.reason;
    EXPECT_TRUE(leaves[i].IsOn(trial.walk));
    EXPECT_TRUE(trial.is_goal_true);
    EXPECT_THAT(trial.walk.false_claims, IsEmpty());
    EXPECT_LT(trial.greatest_tilt, 5 * kDegree);
    ASSERT_EQ(trial.walk.steps.size(), 8u);
    for (int can = 0; can < 2; ++can) {
      const bool is_full = world->masses.at(PartId(can)) > kSpillable;
      EXPECT_THAT(trial.walk.steps[4 * can + 2].action,
                  HasSubstr(is_full ? "transferUpright" : "transfer("));
    }
    if (i == 1) ExpectSame(trial, RunTrial(scenario, tree, {i + 1, *world}, {}));
  }
}

// The cans end on the second table although the sensing was wrong.
TEST(TreeTrials, SensingThatErrsIsToldByTheAudit) {
  const KnowledgeScenario scenario = TwoCans();
  const TreeTrial trial =
      RunTrial(scenario, TreeOf(scenario), {1, kOneFull}, {.sensing_errors = 1});
  EXPECT_EQ(trial.outcome, TrialOutcome::kFalseClaim);
  EXPECT_TRUE(trial.is_goal_true);
  ASSERT_EQ(trial.walk.false_claims.size(), 2u);
  const FalseClaim& first = trial.walk.false_claims.front();
  EXPECT_EQ(first.step, 2);
  EXPECT_EQ(first.atom, "isSpillable(can1)");
  EXPECT_FALSE(first.claimed);
  EXPECT_TRUE(first.is_true);
  EXPECT_THAT(trial.reason, HasSubstr("isSpillable(can1) is claimed to be false and is true"));
}

// The plan does not weigh can1, and no query asks whether it is spillable.
TEST(TreeTrials, AnInitThatIsNotTrueIsToldByTheAudit) {
  const KnowledgeScenario scenario = TwoCans(WithInit("add(Kf, !isSpillable(can1))"));
  const TreeTrial trial = RunTrial(scenario, TreeOf(scenario), {1, kOneFull}, {});
  EXPECT_EQ(trial.outcome, TrialOutcome::kFalseClaim);
  EXPECT_TRUE(trial.is_goal_true);
  ASSERT_EQ(trial.walk.false_claims.size(), 1u);
  EXPECT_EQ(trial.walk.false_claims.front().step, 0);
  EXPECT_THAT(trial.reason, HasSubstr("isSpillable(can1) is claimed to be false and is true"));
}

TEST(TreeTrials, ASpilledCanIsCaught) {
  KnowledgeScenario scenario = TwoCans();
  // The can is full to the brim, and every motion spills it.
  scenario.interpretation.spill->beyond = 1e-5;
  const TreeTrial trial = RunTrial(scenario, TreeOf(scenario), {1, kOneFull}, {});
  EXPECT_EQ(trial.outcome, TrialOutcome::kSpilled);
  EXPECT_THAT(trial.spilled, ElementsAre("can1"));  // the other can is not spillable
  EXPECT_TRUE(trial.is_goal_true);
}

// The can weighs 0.255 kg, and the sensor's error is 1 N. The threshold of 0.25 kg is within that
// error.
TEST(TreeTrials, WhatTheSensorLeavesOpenIsSaid) {
  const KnowledgeScenario scenario = TwoCans({{"error: 0.3", "error: 1"}});
  const HiddenWorld world = {{{PartId(0), 0.255}, {PartId(1), 0.1}}};
  const TreeTrial trial = RunTrial(scenario, TreeOf(scenario), {1, world}, {});
  EXPECT_EQ(trial.outcome, TrialOutcome::kUncertain);
  EXPECT_THAT(trial.reason, HasSubstr("isSpillable(can1)"));
  EXPECT_EQ(trial.walk.steps.size(), 6u);  // the can is lifted once and weighed five times
  EXPECT_THAT(trial.walk.false_claims, IsEmpty());
}

// Between the sensing and its branch, the formula is sensed but not yet known.
TEST(TreeTrials, AGoalMayAskThatWhatIsSensedIsNotKnown) {
  const KnowledgeScenario scenario =
      TwoCans(WithGoal("Kw(isSpillable(can1)) & !K(isSpillable(can1)) & !K(!isSpillable(can1))"));
  for (const HiddenWorld& world : {kOneFull, kBothFull}) {
    const TreeTrial trial = RunTrial(scenario, TreeOf(scenario), {1, world}, {});
    EXPECT_EQ(trial.outcome, TrialOutcome::kSucceeded) << trial.reason;
    ASSERT_EQ(trial.walk.steps.size(), 2u);
    EXPECT_EQ(trial.walk.steps.back().action, "senseWeight(can1)");
  }
}

// The goal asks for the sensing, and no branch depends on it.
TEST(TreeTrials, WhatTheGoalAsksOfSensingIsMadeWrongToo) {
  const KnowledgeScenario scenario = TwoCans(WithGoal("Kw(isSpillable(can1))"));
  for (const double errors : {0.0, 1.0}) {
    const TreeTrial trial =
        RunTrial(scenario, TreeOf(scenario), {1, kOneFull}, {.sensing_errors = errors});
    EXPECT_EQ(trial.walk.is_flipped, errors > 0);
    std::vector<std::string> atoms;
    for (const FalseClaim& claim : trial.walk.false_claims) atoms.push_back(claim.atom);
    EXPECT_EQ(atoms, std::vector<std::string>(errors > 0 ? 1 : 0, "isSpillable(can1)"));
  }
}

// A post stands in the straight way. A can that is carried around it upright does not spill, and a
// can that is carried around it with any tilt does.
TEST(TreeTrials, WhatIsCarriedAroundAPostSpillsUnlessItIsKeptUpright) {
  const auto run = [](const Replacements& replacements) {
    const KnowledgeScenario scenario = TwoCans(replacements, "post");
    return RunTrial(scenario, TreeOf(scenario), {1, kOneFull}, {});
  };
  const TreeTrial upright = run({});
  EXPECT_EQ(upright.outcome, TrialOutcome::kSucceeded) << upright.reason;
  EXPECT_LT(upright.greatest_tilt, 5 * kDegree);
  const TreeTrial any = run({{", upright: 5}", "}"}});
  EXPECT_EQ(any.outcome, TrialOutcome::kSpilled);
  EXPECT_THAT(any.spilled, ElementsAre("can1"));
  EXPECT_THAT(any.collisions, IsEmpty());
}

// The post is put into the way after the motions have been planned without it there.
TEST(TreeTrials, AnArmThatRunsIntoSomethingHasFailed) {
  const KnowledgeScenario scenario = TwoCans({{"at: [650, -142]", "at: [850, -640]"}}, "post");
  const geometry::Vector3 into_the_way(-0.2, 0.498, 0);
  HiddenWorld world = kOneFull;
  world.fault = Fault{.action = "transferUpright", .part = PartId(2), .way = into_the_way};
  const TreeTrial trial = RunTrial(scenario, TreeOf(scenario), {1, world}, {});
  EXPECT_EQ(trial.outcome, TrialOutcome::kCollided) << trial.reason;
  EXPECT_TRUE(trial.IsFailed());
  ASSERT_FALSE(trial.collisions.empty());
  EXPECT_THAT(trial.reason,
              AllOf(HasSubstr("transferUpright(can1): "), HasSubstr(" touched part/post")));
}

// The other can is put where this one is to be put down, in the middle of the second table.
TEST(TreeTrials, AHeldPartThatRunsIntoAnotherHasFailed) {
  const KnowledgeScenario scenario = TwoCans();
  HiddenWorld world = kOneFull;
  world.fault = Fault{.action = "ungrasp", .part = PartId(1), .way = {-0.03, 0.85, 0}};
  const TreeTrial trial = RunTrial(scenario, TreeOf(scenario), {1, world}, {});
  EXPECT_TRUE(trial.IsFailed());
  ASSERT_FALSE(trial.collisions.empty());
  EXPECT_EQ(trial.collisions.front().robot, "part/can1");
  EXPECT_EQ(trial.collisions.front().other, "part/can2");
}

TEST(TreeTrials, WhatCannotBeReachedStopsTheWalk) {
  const KnowledgeScenario scenario = TwoCans({
      {"at: [550, -300]", "at: [860, -650]"},
      {"workcell: two-tables", "workcell: two-tables\nrules: {safe_height: 1500}"},
  });
  const TreeTrial trial = RunTrial(scenario, TreeOf(scenario), {1, kBothFull}, {});
  EXPECT_EQ(trial.outcome, TrialOutcome::kStopped);
  EXPECT_THAT(trial.reason, HasSubstr("grasp(can1): no grasp of can1 is reachable"));
  EXPECT_THAT(trial.walk.false_claims, IsEmpty());
  EXPECT_FALSE(trial.is_goal_true);
}

}  // namespace
}  // namespace assay::execution::tree_trial_test
