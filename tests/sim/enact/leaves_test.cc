#include "sim/enact/leaves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/enact/two_cans.h"

namespace assay::enact {
namespace {

using testing::ElementsAre;

std::vector<std::string> Texts(const std::vector<Leaf>& leaves) {
  std::vector<std::string> texts;
  for (const Leaf& leaf : leaves) texts.push_back(leaf.Text());
  return texts;
}

TEST(Leaves, ThoseOfThePapersTree) {
  const KnowledgeScenario scenario = TwoCans();
  const auto leaves = LeavesOf(scenario.interpretation.task, TreeOf(scenario), 100);
  EXPECT_THAT(Texts(leaves), ElementsAre("isSpillable(can1), isSpillable(can2)",
                                         "isSpillable(can1), !isSpillable(can2)",
                                         "!isSpillable(can1), isSpillable(can2)",
                                         "!isSpillable(can1), !isSpillable(can2)"));
}

// Shared sub-plans are gone through once for each way to them.
TEST(Leaves, TwoToTheNumberOfCans) {
  for (const auto& [name, count] : {std::pair("three-cans", 8u), std::pair("five-cans", 32u)}) {
    const KnowledgeScenario scenario =
        Load(kRoot / "scenarios" / (std::string(name) + ".yaml"), kRoot / "models");
    EXPECT_EQ(LeavesOf(scenario.interpretation.task, TreeOf(scenario), 100).size(), count);
  }
}

TEST(Leaves, WorldsThatLeadThere) {
  const KnowledgeScenario scenario = TwoCans();
  RandomStream random(1, "worlds");
  for (const Leaf& leaf : LeavesOf(scenario.interpretation.task, TreeOf(scenario), 100)) {
    for (int i = 0; i < 20; ++i) {
      const auto world = WorldFor(leaf, scenario.interpretation, scenario.scenario.problem, random);
      ASSERT_TRUE(world);
      const auto said = [&](int can) {
        return std::string(world->masses.at(PartId(can)) > 0.25 ? "" : "!") + "isSpillable(can" +
               std::to_string(can + 1) + ")";
      };
      EXPECT_EQ(leaf.Text(), said(0) + ", " + said(1));
    }
  }
}

TEST(Leaves, ThatNoWorldLeadsTo) {
  const KnowledgeScenario scenario =
      TwoCans({{"can1: {mass: [[0.06, 0.12], [0.38, 0.48]]}", "can1: {mass: [[0.06, 0.12]]}"}});
  RandomStream random(1, "worlds");
  std::vector<bool> are_reachable;
  for (const Leaf& leaf : LeavesOf(scenario.interpretation.task, TreeOf(scenario), 100)) {
    are_reachable.push_back(
        WorldFor(leaf, scenario.interpretation, scenario.scenario.problem, random).has_value());
  }
  EXPECT_THAT(are_reachable, ElementsAre(false, false, true, true));
  const Leaf first = LeavesOf(scenario.interpretation.task, TreeOf(scenario), 100).front();
  const auto why = FindWorld(first, scenario.interpretation, scenario.scenario.problem, random);
  EXPECT_EQ(std::get<std::string>(why), "nothing that can1 may hide makes isSpillable(can1)");
}

}  // namespace
}  // namespace assay::enact
