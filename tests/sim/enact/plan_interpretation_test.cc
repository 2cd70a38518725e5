#include "sim/enact/plan_interpretation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/enact/enactment.h"
#include "sim/enact/leaves.h"
#include "sim/render/renderer.h"

namespace assay::enact {
namespace {

using testing::IsEmpty;

class FallenPeg : public testing::Test {
 protected:
  void SetUp() override {
    if (render::AvailableRenderer().empty()) GTEST_SKIP() << "nothing renders on this machine";
  }

  static const KnowledgeScenario& Scenario() {
    static const KnowledgeScenario scenario =
        Load(ASSAY_SOURCE_DIR "/scenarios/fallen-peg.yaml", ASSAY_SOURCE_DIR "/models");
    return scenario;
  }
  static EnactedTrial Run(int world, double sensing_errors = 0) {
    return RunTrial(Scenario(), Scenario().interpretation.planned->assembly.tree,
                    {1, {.masses = {}, .colors = {}, .world = world}},
                    {.seed = 1, .sensing_errors = sensing_errors});
  }
};

// The camera tells how the peg lies, and each plan leads to the goal.
TEST_F(FallenPeg, EachWorldReachesTheGoal) {
  for (const auto& [world, told] :
       {std::pair(0, "pose(peg) = lying"), std::pair(1, "pose(peg) = standing")}) {
    const EnactedTrial trial = Run(world);
    EXPECT_EQ(trial.outcome, EnactmentOutcome::kReached) << trial.reason;
    EXPECT_TRUE(trial.is_goal_true);
    EXPECT_THAT(trial.walk.false_claims, IsEmpty());
    EXPECT_EQ(trial.walk.branches.front().text, told);
  }
}

// Where errors lead something is made to go wrong: a recovery mends it, or a person is called.
TEST_F(FallenPeg, EveryBranchIsComeTo) {
  const Interpretation& interpretation = Scenario().interpretation;
  const contingent::PlanTree& tree = interpretation.planned->assembly.tree;
  int repeats = 0;
  int mishaps = 0;
  for (const Leaf& leaf : LeavesOf(interpretation.task, tree, 100)) {
    if (leaf.branches.front().text != "pose(peg) = lying") continue;  // the other is alike
    RandomStream random(1, "worlds");
    const auto world = WorldFor(leaf, interpretation, Scenario().scenario.problem, random);
    ASSERT_TRUE(world) << leaf.Text();
    const EnactedTrial trial = RunTrial(Scenario(), tree, {1, *world}, {.seed = 1});
    EXPECT_TRUE(leaf.IsOn(trial.walk)) << leaf.Text() << ": " << trial.mishap;
    EXPECT_FALSE(trial.IsFailed()) << leaf.Text() << ": " << trial.reason;
    EXPECT_EQ(world->mishap.has_value(), !trial.mishap.empty());
    if (leaf.is_repeat) ++repeats;
    if (world->mishap) ++mishaps;
  }
  EXPECT_EQ(repeats, 1);
  EXPECT_EQ(mishaps, 2);
}

// A peg that stands is claimed to lie: the audit tells at once.
TEST_F(FallenPeg, AWrongPoseIsAFalseClaim) {
  const EnactedTrial trial = Run(1, 1);
  EXPECT_EQ(trial.outcome, EnactmentOutcome::kFalseClaim);
  ASSERT_FALSE(trial.walk.false_claims.empty());
  EXPECT_EQ(trial.walk.false_claims.front().step, 1);
}

}  // namespace
}  // namespace assay::enact
