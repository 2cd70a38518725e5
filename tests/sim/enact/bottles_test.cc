#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/contingent/contingent_planner.h"
#include "planner/contingent/tree_text.h"
#include "sim/enact/enactment.h"
#include "sim/render/renderer.h"

namespace assay::enact {
namespace {

using testing::IsEmpty;

struct Planned {
  KnowledgeScenario scenario;
  contingent::PlanTree tree;

  explicit Planned(const std::string& name)
      : scenario(
            Load(ASSAY_SOURCE_DIR "/scenarios/" + name + ".yaml", ASSAY_SOURCE_DIR "/models")) {
    Budget budget(1'000'000);
    tree = MakePlan(scenario.interpretation.task, contingent::Wanted::kFirst, budget).tree;
  }

  EnactedTrial Run(const Leaf& leaf, int number, double sensing_errors = 0) const {
    RandomStream random(1, "world");
    const auto world = WorldFor(leaf, scenario.interpretation, scenario.scenario.problem, random);
    return RunTrial(scenario, tree, {number, world.value()},
                    {.seed = 1, .sensing_errors = sensing_errors});
  }
  std::vector<Leaf> Leaves() const { return LeavesOf(scenario.interpretation.task, tree, 100); }
};

class Bottles : public testing::Test {
 protected:
  void SetUp() override {
    if (render::AvailableRenderer().empty()) GTEST_SKIP() << "nothing renders on this machine";
  }
};

// Facts 5.8; who reaches which place is computed, and nowhere said.
TEST_F(Bottles, HandOverEmergesFromGeometry) {
  const Planned bottle("bottles");
  EXPECT_EQ(
      TextOf(bottle.scenario.interpretation.task, bottle.tree, contingent::Sharing::kUnfolded),
      "senseIfEmpty(bottle)\n"
      "branch isEmptyBottle(bottle)\n"
      "  pickUp(left, bottle, tableLeft)\n"
      "  putDown(left, bottle, shared)\n"
      "  pickUp(right, bottle, shared)\n"
      "  putDown(right, bottle, dishwasher)\n"
      "branch !isEmptyBottle(bottle)\n");
}

TEST_F(Bottles, EveryBranchReachesTheGoal) {
  const Planned bottle("bottles");
  int number = 0;
  for (const Leaf& leaf : bottle.Leaves()) {
    const EnactedTrial trial = bottle.Run(leaf, ++number);
    EXPECT_EQ(trial.outcome, EnactmentOutcome::kReached) << leaf.Text() << ": " << trial.reason;
    EXPECT_TRUE(trial.is_goal_true);
    EXPECT_THAT(trial.walk.false_claims, IsEmpty());
    EXPECT_TRUE(leaf.IsOn(trial.walk)) << leaf.Text();
  }
  EXPECT_EQ(number, 2);
}

// What the camera told is made wrong: a full bottle is taken for an empty one, or the other way
// round, and whatever comes of it, the claim is caught.
TEST_F(Bottles, WrongSensingIsCaught) {
  const Planned bottle("bottles");
  for (const Leaf& leaf : bottle.Leaves()) {
    const EnactedTrial trial = bottle.Run(leaf, 1, 1);
    EXPECT_EQ(trial.outcome, EnactmentOutcome::kFalseClaim) << leaf.Text();
    ASSERT_FALSE(trial.walk.false_claims.empty());
    EXPECT_EQ(trial.walk.false_claims.front().atom, "isEmptyBottle(bottle)");
  }
}

}  // namespace
}  // namespace assay::enact
