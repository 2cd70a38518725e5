#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/contingent/search/contingent_planner.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/execution/trial/tree_trial.h"
#include "sim/render/renderer.h"
#include "tests/scratch_file.h"

namespace assay::execution::bottles_test {
namespace {

using testing::IsEmpty;

constexpr const char* kOneBottle = ASSAY_SOURCE_DIR "/scenarios/bottles.yaml";

struct Planned {
  KnowledgeScenario scenario;
  contingent::PlanTree tree;

  explicit Planned(const std::filesystem::path& file)
      : scenario(Load(file, ASSAY_SOURCE_DIR "/models")) {
    Budget budget(1'000'000);
    tree = MakePlan(scenario.interpretation.task, contingent::Wanted::kFirst, budget).tree;
  }

  TreeTrial Run(const Leaf& leaf, int number, double sensing_errors = 0) const {
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

// The scenario does not say which robot reaches which place. The program computes this.
TEST_F(Bottles, HandOverEmergesFromGeometry) {
  const Planned bottle(kOneBottle);
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
  const Planned bottle(kOneBottle);
  int number = 0;
  for (const Leaf& leaf : bottle.Leaves()) {
    const TreeTrial trial = bottle.Run(leaf, ++number);
    EXPECT_EQ(trial.outcome, TrialOutcome::kSucceeded) << leaf.Text() << ": " << trial.reason;
    EXPECT_TRUE(trial.is_goal_true);
    EXPECT_THAT(trial.walk.false_claims, IsEmpty());
    EXPECT_TRUE(leaf.IsOn(trial.walk)) << leaf.Text();
  }
  EXPECT_EQ(number, 2);
}

// Returns a scenario of three bottles in which one look senses whether two of them are both empty.
std::filesystem::path LookAtBoth() {
  std::ofstream(ScratchFile("both.pks"))
      << "domain both types: object predicates: isEmptyBottle(object)\n"
         "action lookAtBoth(?a: object, ?b: object) preconds: K(?a != ?b)\n"
         "  effects: add(Kw, isEmptyBottle(?a) & isEmptyBottle(?b))\n";
  std::ofstream(ScratchFile("both-problem.pks"))
      << "problem both domain both objects: bottle1, bottle2, bottle3: object\n"
         "goal: Kw(isEmptyBottle(bottle1) & isEmptyBottle(bottle3))\n";
  std::ostringstream text;
  text << std::ifstream(ASSAY_SOURCE_DIR "/scenarios/three-bottles.yaml").rdbuf();
  const std::string scenario = text.str();
  const std::string knowledge =
      "knowledge:\n  domain: both.pks\n  problem: both-problem.pks\n"
      "  colors: {full: [0.16, 0.45, 0.22], empty: [0.65, 0.82, 0.95]}\n"
      "  actions:\n    lookAtBoth: {skill: look}\n"
      "  predicates:\n    isEmptyBottle: {is: colored, color: empty}\n";
  const std::filesystem::path file = ScratchFile("both.yaml");
  std::ofstream(file) << scenario.substr(0, scenario.find("knowledge:")) << knowledge
                      << scenario.substr(scenario.find("  hidden:"));
  return file;
}

TEST_F(Bottles, AreLookedAtTogether) {
  const Planned bottles(LookAtBoth());
  ASSERT_EQ(SizeOf(bottles.tree).depth, 1);
  const TreeTrial trial = bottles.Run(bottles.Leaves().front(), 1);
  EXPECT_EQ(trial.outcome, TrialOutcome::kSucceeded) << trial.reason;
  EXPECT_THAT(trial.walk.false_claims, IsEmpty());
}

// The sensing is made wrong, so that a full bottle is taken for an empty one or an empty one for a
// full one. The audit must catch the false claim on every leaf.
TEST_F(Bottles, WrongSensingIsCaught) {
  const Planned bottle(kOneBottle);
  for (const Leaf& leaf : bottle.Leaves()) {
    const TreeTrial trial = bottle.Run(leaf, 1, 1);
    EXPECT_EQ(trial.outcome, TrialOutcome::kFalseClaim) << leaf.Text();
    ASSERT_FALSE(trial.walk.false_claims.empty());
    EXPECT_EQ(trial.walk.false_claims.front().atom, "isEmptyBottle(bottle)");
  }
}

}  // namespace
}  // namespace assay::execution::bottles_test
