#include "sim/execution/hidden_worlds/leaves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/execution/interpretation/knowledge_scenario.h"
#include "tests/sim/execution/two_cans.h"

namespace assay::execution::leaves_test {
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

// A sub-plan that several branches share has its own leaf for each way to it.
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

// The masses of can1 reach only just over the threshold. 1 in 10,000 of them does.
TEST(Leaves, RareWorldsAreDrawnFromWhatTheLeafAsks) {
  const KnowledgeScenario scenario =
      TwoCans({{"can1: {mass: [[0.06, 0.12], [0.38, 0.48]]}", "can1: {mass: [[0.06, 0.25002]]}"}});
  RandomStream random(1, "worlds");
  for (const Leaf& leaf : LeavesOf(scenario.interpretation.task, TreeOf(scenario), 100)) {
    const auto world = WorldFor(leaf, scenario.interpretation, scenario.scenario.problem, random);
    ASSERT_TRUE(world) << leaf.Text();
    const double mass = world->masses.at(PartId(0));
    EXPECT_GE(mass, 0.06);
    EXPECT_LE(mass, 0.25002);
    EXPECT_EQ(mass > 0.25, leaf.Text().starts_with("isSpillable(can1)")) << mass;
  }
}

std::vector<std::string> WhyNoWorldLeadsThere(const KnowledgeScenario& scenario) {
  std::vector<std::string> whys;
  RandomStream random(1, "worlds");
  for (const Leaf& leaf : LeavesOf(scenario.interpretation.task, TreeOf(scenario), 100)) {
    const auto found = FindWorld(leaf, scenario.interpretation, scenario.scenario.problem, random);
    const auto* why = std::get_if<std::string>(&found);
    whys.push_back(why != nullptr ? *why : "");
  }
  return whys;
}

// By its model, a can weighs 0.25 kg or more. A bottle has neither of the two named colours.
TEST(Leaves, WhatIsNotHiddenIsKnown) {
  KnowledgeScenario cans = TwoCans();
  cans.interpretation.hidden.erase(PartId(1));
  const char* const kLight = "the known properties of can2 exclude !isSpillable(can2)";
  EXPECT_THAT(WhyNoWorldLeadsThere(cans), ElementsAre("", kLight, "", kLight));
  KnowledgeScenario bottle = Load(kRoot / "scenarios/bottles.yaml", kRoot / "models");
  bottle.interpretation.hidden.clear();
  EXPECT_THAT(WhyNoWorldLeadsThere(bottle),
              ElementsAre("the known properties of bottle exclude isEmptyBottle(bottle)", ""));
}

contingent::GroundLiteral LiteralOf(const KnowledgeScenario& scenario, const std::string& atom) {
  const std::vector<std::string>& atoms = scenario.interpretation.task.atoms;
  return {contingent::AtomId(static_cast<int>(std::ranges::find(atoms, atom) - atoms.begin())),
          true};
}

// No sensor measures whether can2 is grasped, and no hidden quantity can make it true. If a
// conjunction with this literal is denied, its other literal must be false.
class LeavesOfWhatNoSensorTells : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Meanings, LeavesOfWhatNoSensorTells,
                         testing::Values("{is: internal}", "{is: held}"));
TEST_P(LeavesOfWhatNoSensorTells, AreNotComeTo) {
  const KnowledgeScenario scenario = TwoCans({{"{is: held}", GetParam()}});
  const domain::Problem& problem = scenario.scenario.problem;
  const contingent::GroundLiteral internal = LiteralOf(scenario, "isGrasped(can2)");
  RandomStream random(1, "worlds");
  Leaf denied;
  denied.denied.push_back({LiteralOf(scenario, "isSpillable(can1)"), internal});
  for (int i = 0; i < 20; ++i) {
    const auto world = WorldFor(denied, scenario.interpretation, problem, random);
    ASSERT_TRUE(world);
    EXPECT_LT(world->masses.at(PartId(0)), 0.25);
  }
  Leaf held;
  held.literals = {internal};
  EXPECT_EQ(std::get<std::string>(FindWorld(held, scenario.interpretation, problem, random)),
            "no sensor tells whether isGrasped(can2)");
}

// If the conjunction of both literals is denied, either of them may be the false one.
TEST(Leaves, DeniedConjunctionsHaveCases) {
  const KnowledgeScenario scenario =
      TwoCans({{"can1: {mass: [[0.06, 0.12], [0.38, 0.48]]}", "can1: {mass: [[0.38, 0.48]]}"}});
  Leaf leaf;
  leaf.denied.push_back(
      {LiteralOf(scenario, "isSpillable(can1)"), LiteralOf(scenario, "isSpillable(can2)")});
  RandomStream random(1, "worlds");
  for (int i = 0; i < 20; ++i) {
    const auto world = WorldFor(leaf, scenario.interpretation, scenario.scenario.problem, random);
    ASSERT_TRUE(world);
    EXPECT_GT(world->masses.at(PartId(0)), 0.25);
    EXPECT_LT(world->masses.at(PartId(1)), 0.25);
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
  EXPECT_EQ(std::get<std::string>(why),
            "the possible hidden properties of can1 exclude isSpillable(can1)");
}

}  // namespace
}  // namespace assay::execution::leaves_test
