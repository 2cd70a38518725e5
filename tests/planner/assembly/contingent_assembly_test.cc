#include "planner/assembly/contingent_assembly.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/contingent/pks_file.h"
#include "planner/contingent/tree_check.h"
#include "tests/planner/posting/scenarios.h"

namespace assay::assembly {
namespace {

using contingent::PlanNode;
using Kind = KnowledgeAction::Kind;

std::vector<domain::Problem> WorldsFrom(const std::string& text) {
  return domain::ReadWorlds(Document::Parse(text, "scenario.yaml"),
                            std::string(ASSAY_SOURCE_DIR) + "/models", {});
}

// Block and peg without errors: nothing is left to verify.
std::string Exact(const std::string& block_pose, const std::string& peg_pose) {
  return posting::PegAndBlock(block_pose, peg_pose);
}

constexpr const char* kBlockOnBack = "{stable: on-back, at: [24, 2], yaw: 30}";
constexpr const char* kLyingOrStanding =
    "{one-of: {lying: {stable: on-side, at: [20, -8], yaw: -120}, "
    "standing: {stable: shaft-up, at: [20, -8], yaw: -20}}}";

const KnowledgeAction& ActionOf(const ContingentAssembly& assembly, contingent::NodeId node) {
  const contingent::GroundTask& task = assembly.knowledge.task;
  const PlanNode& acting = assembly.tree.node(node);
  return assembly.knowledge.actions.at(task.actions[acting.action.index()].name);
}

int Count(const ContingentAssembly& assembly, Kind kind) {
  int count = 0;
  for (std::size_t n = 0; n < assembly.tree.nodes.size(); ++n) {
    const contingent::NodeId node(n);
    if (assembly.tree.node(node).kind != PlanNode::Kind::kAct) continue;
    count += ActionOf(assembly, node).kind == kind ? 1 : 0;
  }
  return count;
}

void ExpectHoldsInAllWorlds(const ContingentAssembly& assembly) {
  ASSERT_EQ(assembly.outcome, Outcome::kFound);
  const auto check = contingent::CheckTree(assembly.knowledge.task, assembly.tree);
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_TRUE(check.are_all_worlds);
}

// Spar's figures 15 and 16, whichever of the two it turns out to be.
TEST(ContingentAssembly, AnOpenPoseIsLookedAtAndEachPoseHasItsPlan) {
  std::string text = Exact(kBlockOnBack, kLyingOrStanding);
  text.insert(text.find("goal:"), "sensing: [overhead-camera]\n");
  const std::vector<domain::Problem> worlds = WorldsFrom(text);
  ASSERT_EQ(worlds.size(), 2U);
  const ContingentAssembly assembly = MakeContingentPlan(worlds, {}, {});
  ExpectHoldsInAllWorlds(assembly);
  ASSERT_EQ(assembly.plans.size(), 2U);
  EXPECT_EQ(assembly.plans[0].worlds, std::vector{0});
  EXPECT_EQ(assembly.plans[1].worlds, std::vector{1});
  EXPECT_EQ(ActionOf(assembly, assembly.tree.root).kind, Kind::kLook);
  EXPECT_EQ(Count(assembly, Kind::kLook), 1);
  EXPECT_EQ(Count(assembly, Kind::kStep), 2 + 4);
}

TEST(ContingentAssembly, NothingIsLookedAtThatDoesNotMatter) {
  std::string text = Exact(kBlockOnBack, "{stable: on-side, at: [20, -8], yaw: -120}");
  text.insert(text.find("goal:"), "sensing: [overhead-camera]\n");
  text.insert(text.find("  peg:"),
              "  brick: {model: brick, pose: {one-of: {here: {stable: upright, at: [34, 15]}, "
              "there: {stable: upright, at: [34, 12]}}}}\n");
  const ContingentAssembly assembly = MakeContingentPlan(WorldsFrom(text), {}, {});
  ExpectHoldsInAllWorlds(assembly);
  EXPECT_EQ(assembly.plans.size(), 1U);
  EXPECT_EQ(Count(assembly, Kind::kLook), 0);
  EXPECT_EQ(Count(assembly, Kind::kStep), 2);
}

TEST(ContingentAssembly, WithoutASensorNothingTellsWhichPoseItIs) {
  const ContingentAssembly assembly =
      MakeContingentPlan(WorldsFrom(Exact(kBlockOnBack, kLyingOrStanding)), {}, {});
  EXPECT_EQ(assembly.outcome, Outcome::kNone);
  EXPECT_EQ(assembly.conflict, std::vector<std::string>{"no sensor tells which pose peg has"});
}

// Spar's verifications and recoveries as branches: after the pickup error1 (a groping search, so a
// repeat) and error2 (the operator), after the assembly error3 (the operator) and error4 (a
// search).
TEST(ContingentAssembly, VerificationsBranchAndRecoveriesRepeat) {
  const domain::Problem problem = posting::LoadScenario("uncertain-failing");
  const ContingentAssembly assembly = MakeContingentPlan({problem}, {}, {});
  ExpectHoldsInAllWorlds(assembly);
  ASSERT_EQ(assembly.plans.front().plan.verifications.size(), 2U);
  EXPECT_EQ(Count(assembly, Kind::kStep), 2);
  EXPECT_EQ(Count(assembly, Kind::kVerify), 2);
  EXPECT_EQ(Count(assembly, Kind::kRecover), 2);
  EXPECT_EQ(Count(assembly, Kind::kOperator), 2);
  EXPECT_EQ(contingent::SizeOf(assembly.tree).repeats, 2);
}

TEST(ContingentAssembly, TheKnowledgeIsReadBackFromItsText) {
  const domain::Problem problem = posting::LoadScenario("uncertain-failing");
  const PlanKnowledge knowledge = MakeContingentPlan({problem}, {}, {}).knowledge;
  EXPECT_EQ(contingent::ReadPksDomain(knowledge.domain, "d.pks").actions.size(),
            knowledge.actions.size());
  EXPECT_EQ(contingent::ReadPksProblem(knowledge.problem, "p.pks").domain, "uncertain-failing");
}

}  // namespace
}  // namespace assay::assembly
