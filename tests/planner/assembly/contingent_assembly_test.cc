#include "planner/assembly/contingent_assembly.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/knowledge/knowledge_base.h"
#include "planner/contingent/pks_and_pddl/pks_file.h"
#include "planner/contingent/pks_and_pddl/pks_text.h"
#include "planner/contingent/plan_tree/tree_file.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "planner/numeric/interval_arithmetic.h"
#include "tests/planner/constraint_posting/scenarios.h"
#include "tests/scratch_file.h"

namespace assay::assembly::contingent_assembly_test {
namespace {

using contingent::PlanNode;
using Kind = KnowledgeAction::Kind;

std::vector<domain::Problem> WorldsFrom(const std::string& text) {
  return domain::ReadWorlds(Document::Parse(text, "scenario.yaml"),
                            std::string(ASSAY_SOURCE_DIR) + "/models", {});
}

// Returns a scenario with block and peg without errors, so that no verification is needed.
std::string Exact(const std::string& block_pose, const std::string& peg_pose) {
  return constraint_posting::PegAndBlock(block_pose, peg_pose);
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

// Reads the task back as `assay contingent` reads the exported files.
contingent::GroundTask ReadBack(const PlanKnowledge& knowledge) {
  contingent::Externs externs;
  return contingent::Ground(contingent::ReadPksDomain(TextOf(knowledge.domain), "d.pks"),
                            contingent::ReadPksProblem(TextOf(knowledge.problem), "p.pks"),
                            externs);
}

void ExpectHoldsInAllWorlds(const ContingentAssembly& assembly) {
  ASSERT_EQ(assembly.outcome, Outcome::kFound);
  const auto check = contingent::CheckTree(ReadBack(assembly.knowledge), assembly.tree);
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_TRUE(check.AreAllWorlds());
}

// The scenario is figure 15 or 16 of Spar, and the pose of the peg decides which.
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
  // The outcome is no proof, because a plan that needs no look may exist. Only one plan is tried
  // for each world.
  EXPECT_EQ(assembly.outcome, Outcome::kBudget);
  EXPECT_EQ(assembly.unplanned.limits.back(), "no sensor tells which pose peg has");
}

// A distance of a tenth of a millimetre is less than the camera promises to resolve, and half an
// inch is more.
TEST(ContingentAssembly, PosesThatLookAlikeAreNotToldApart) {
  const auto assembly_with = [](const std::string& x) {
    std::string text = Exact(kBlockOnBack,
                             "{one-of: {here: {stable: on-side, at: [20, -8], yaw: -120}, "
                             "there: {stable: on-side, at: [" +
                                 x + ", -8], yaw: -120}}}");
    text.insert(text.find("goal:"), "sensing: [overhead-camera]\n");
    return MakeContingentPlan(WorldsFrom(text), {}, {});
  };
  const ContingentAssembly alike = assembly_with("20.004");
  EXPECT_EQ(alike.outcome, Outcome::kBudget);
  EXPECT_THAT(
      alike.unplanned.limits,
      testing::ElementsAre(
          testing::StartsWith("only one plan is considered for each world"),
          testing::StartsWith(
              "sensor overhead-camera cannot distinguish pose here of part peg from pose there"),
          "no sensor tells which pose peg has"));
  ExpectHoldsInAllWorlds(assembly_with("20.5"));
}

// Spar's verifications and recoveries become branches. After the pickup these are error1 (a groping
// search, which is a repeat) and error2 (the operator). After the assembly they are error3 (the
// operator) and error4 (a search).
TEST(ContingentAssembly, VerificationsBranchAndRecoveriesRepeat) {
  const domain::Problem problem = constraint_posting::LoadScenario("uncertain-failing");
  const ContingentAssembly assembly = MakeContingentPlan({problem}, {}, {});
  ExpectHoldsInAllWorlds(assembly);
  ASSERT_EQ(assembly.plans.front().plan.verifications.size(), 2U);
  EXPECT_EQ(Count(assembly, Kind::kStep), 2);
  EXPECT_EQ(Count(assembly, Kind::kVerify), 2);
  EXPECT_EQ(Count(assembly, Kind::kRecover), 2);
  EXPECT_EQ(Count(assembly, Kind::kOperator), 2);
  EXPECT_EQ(contingent::SizeOf(assembly.tree).repeats, 2);
}

// Expects that the tree of a plan without looks is the plan itself, with every step in its order.
void ExpectIsThePlan(const ContingentAssembly& assembly) {
  const plan::Plan& plan = assembly.plans.front().plan;
  EXPECT_EQ(Count(assembly, Kind::kLook), 0);
  contingent::NodeId node = assembly.tree.root;
  for (const plan::StepId step : plan.ExecutionOrder()) {
    while (assembly.tree.node(node).kind != PlanNode::Kind::kAct ||
           ActionOf(assembly, node).kind == Kind::kVerify) {
      node = assembly.tree.node(node).children.front();
    }
    EXPECT_EQ(ActionOf(assembly, node).step, step);
    node = assembly.tree.node(node).children.front();
  }
}

std::vector<std::string> AssemblyScenarios() {
  std::vector<std::string> names;
  const std::filesystem::path folder = std::filesystem::path(ASSAY_SOURCE_DIR) / "scenarios";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml" || entry.path().stem() == "impossible") continue;
    const Document scenario = Document::Load(entry.path());
    if (scenario.root().Find("goal")) names.push_back(entry.path().stem());
  }
  std::ranges::sort(names);
  return names;
}

TEST(ContingentAssembly, EveryScenarioHasATreeThatHoldsInAllWorlds) {
  const std::vector<std::string> names = AssemblyScenarios();
  EXPECT_GT(names.size(), 15U);
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const std::string root = ASSAY_SOURCE_DIR;
    const std::vector<domain::Problem> worlds = domain::ReadWorlds(
        Document::Load(root + "/scenarios/" + name + ".yaml"), root + "/models", {});
    const ContingentAssembly assembly = MakeContingentPlan(worlds, {}, {});
    ExpectHoldsInAllWorlds(assembly);
    if (worlds.size() == 1) ExpectIsThePlan(assembly);
  }
}

// Returns the figures 15 and 16 of Spar with their errors, so that plans begin with looks.
std::string Uncertain(const std::string& block_pose, const std::string& peg_pose,
                      const std::string& sensor = "overhead-camera") {
  constexpr const char* kErrors = ", error: {x: 0.11, y: 0.11, z: 0.11, theta: 5.5}";
  return Exact(block_pose + kErrors, peg_pose + kErrors) + "sensing: [" + sensor +
         "]\nresolvers: [sensing, squeezing]\n";
}

constexpr const char* kBlockHereOrThere =
    "{one-of: {here: {stable: on-back, at: [24, 2], yaw: 30}, "
    "there: {stable: on-back, at: [26, 4], yaw: 0}}}";

// The look at the block distinguishes the worlds. The look at the peg is a step of both plans.
TEST(ContingentAssembly, APartWhosePoseIsKnownIsLookedAtInAStep) {
  const std::string text =
      Uncertain(kBlockHereOrThere, "{stable: on-side, at: [20, -8], yaw: -120}");
  const ContingentAssembly assembly = MakeContingentPlan(WorldsFrom(text), {}, {});
  ExpectHoldsInAllWorlds(assembly);
  ASSERT_EQ(assembly.plans.size(), 2U);
  EXPECT_EQ(ActionOf(assembly, assembly.tree.root).kind, Kind::kLook);
  EXPECT_EQ(Count(assembly, Kind::kLook), 1);
  int steps = -2;  // without the look at the block, which is in each plan
  for (const PlanOfWorlds& planned : assembly.plans) {
    steps += static_cast<int>(planned.plan.steps.size());
  }
  EXPECT_EQ(Count(assembly, Kind::kStep), steps);
}

// The tree has one look at the first part. On both branches after this look, it has one look at the
// other part. No part is looked at twice.
TEST(ContingentAssembly, TwoOpenPosesAreLookedAtOnceEach) {
  const ContingentAssembly assembly = MakeContingentPlan(
      WorldsFrom(Uncertain(kBlockHereOrThere, kLyingOrStanding, "coarse-camera")), {}, {});
  ASSERT_EQ(assembly.outcome, Outcome::kFound);
  // Only a few of the 5,832 worlds are checked, because repeats of each are followed in all worlds
  // that forgetting leaves.
  const auto check =
      contingent::CheckTree(ReadBack(assembly.knowledge), assembly.tree, {.worlds = 8});
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_EQ(assembly.plans.size(), 4U);
  EXPECT_EQ(Count(assembly, Kind::kLook), 1 + 2);
}

template <class Texts>
int PlaceOf(const Texts& texts, const std::string& text, auto projection) {
  const auto found = std::ranges::find(texts, text, projection);
  EXPECT_NE(found, texts.end()) << text;
  return static_cast<int>(found - texts.begin());
}

// What was known about the pose of the peg on the table, and about its errors, is no longer known
// when the peg is in the hand.
TEST(ContingentAssembly, APickupForgetsThePoseAndItsIntervals) {
  const ContingentAssembly assembly =
      MakeContingentPlan(WorldsFrom(Uncertain(kBlockOnBack, kLyingOrStanding)), {}, {});
  ASSERT_EQ(assembly.outcome, Outcome::kFound);
  const contingent::GroundTask& task = assembly.knowledge.task;
  const contingent::FunctionId dx(
      PlaceOf(task.functions, "dx(peg)", &contingent::GroundFunction::text));
  const contingent::AtomId lying(PlaceOf(task.atoms, "pose(peg) = lying", std::identity()));
  const contingent::GroundAction& look =
      task.actions[assembly.tree.node(assembly.tree.root).action.index()];
  const auto pickup = std::ranges::find_if(task.actions, [&](const auto& action) {
    const KnowledgeAction& meaning = assembly.knowledge.actions.at(action.name);
    return meaning.kind == Kind::kStep && meaning.plan == 0;
  });

  contingent::KnowledgeBase knowledge(task);
  const auto looked = knowledge.After(look, knowledge.Initial());
  ASSERT_TRUE(looked);
  EXPECT_FALSE(knowledge.Holds(pickup->precondition, *looked));
  const auto ready = *knowledge.Learned(*looked, {lying, true});
  EXPECT_TRUE(knowledge.layout().IsSensed(ready, dx));
  ASSERT_TRUE(knowledge.Holds(pickup->precondition, ready));
  const auto taken = knowledge.After(*pickup, ready);
  ASSERT_TRUE(taken);
  EXPECT_TRUE(knowledge.layout().IsUndetermined(*taken, lying));
  EXPECT_FALSE(knowledge.layout().IsSensed(*taken, dx));
  EXPECT_EQ(taken->ranges[task.functions[dx.index()].slot].high, kInfinity);
  EXPECT_FALSE(knowledge.Holds(look.precondition, *taken));
}

// A scenario is named after its file, which may have any name.
TEST(ContingentAssembly, TheKnowledgeOfAScenarioOfAnyNameIsReadBackFromItsText) {
  domain::Problem problem = constraint_posting::LoadScenario("uncertain-failing");
  problem.name = "parts (2), of -all- kinds";
  const PlanKnowledge knowledge = MakeContingentPlan({problem}, {}, {}).knowledge;
  const contingent::Domain domain = contingent::ReadPksDomain(TextOf(knowledge.domain), "d.pks");
  EXPECT_EQ(domain.actions.size(), knowledge.actions.size());
  EXPECT_EQ(contingent::ReadPksProblem(TextOf(knowledge.problem), "p.pks").domain, domain.name);
}

// Pairs of a text in the file of the workcell or scenario and its replacement.
using Names = std::vector<std::pair<std::string, std::string>>;

std::string Renamed(const std::filesystem::path& file, const Names& names) {
  std::ostringstream read;
  read << std::ifstream(file).rdbuf();
  std::string text = read.str();
  for (const auto& [from, to] : names) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
      text.replace(at, from.size(), to);
    }
  }
  return text;
}

// Returns the scenario of the fallen peg in a workcell with other names.
std::vector<domain::Problem> FallenPegWith(const Names& names) {
  const std::filesystem::path root = ASSAY_SOURCE_DIR;
  const std::filesystem::path models = ScratchFile("models");
  std::filesystem::remove_all(models);
  std::filesystem::copy(root / "models", models, std::filesystem::copy_options::recursive);
  const std::filesystem::path workcell = "workcells/puma762-table/workcell.yaml";
  const std::string changed = Renamed(root / "models" / workcell, names);
  std::ofstream(models / workcell) << changed;
  const std::string scenario = Renamed(root / "scenarios/fallen-peg.yaml", names);
  return domain::ReadWorlds(Document::Parse(scenario, "scenario.yaml"), models, {});
}

// The names include texts that a .pks file cannot contain as names, the word of a section and the
// name of a step in .pks files, and two names that become equal when they are written to a .pks
// file.
TEST(ContingentAssembly, SensorsAndErrorsMayHaveAnyNames) {
  for (const auto& [below, above] :
       {std::pair{"goal", "plan1-action_1"}, {"2nd try?", "-- 2nd try"}}) {
    const Names names = {{"coarse-camera", "\"camera no. 1 (\u00fcber dem Tisch)\""},
                         {"error3", fmt::format("\"{}\"", below)},
                         {"error4", fmt::format("\"{}\"", above)}};
    const ContingentAssembly assembly = MakeContingentPlan(FallenPegWith(names), {}, {});
    ASSERT_EQ(assembly.outcome, Outcome::kFound);
    const contingent::GroundTask task = ReadBack(assembly.knowledge);
    EXPECT_EQ(task.actions.size(), assembly.knowledge.actions.size());
    EXPECT_TRUE(contingent::CheckTree(task, assembly.tree, {.worlds = 8}).holds);
    const std::string json = contingent::ToJson(task, assembly.tree).dump();
    EXPECT_EQ(contingent::ReadTree(Document::Parse(json, "tree.json").root(), task).nodes,
              assembly.tree.nodes);
    std::set<std::string> named;
    for (const auto& [constant, name] : assembly.knowledge.names) named.insert(name);
    EXPECT_THAT(named,
                testing::IsSupersetOf<std::string>({below, above, "peg", "lying", "standing"}));
  }
}

// The names include keywords of .pks files, names that other things have in the written .pks file,
// and texts that a .pks file cannot contain as names.
TEST(ContingentAssembly, PartsAndPosesMayHaveAnyNames) {
  std::string text = Exact(kBlockOnBack, kLyingOrStanding);
  text.insert(text.find("goal:"), "sensing: [overhead-camera]\n");
  const std::vector<domain::Problem> worlds = WorldsFrom(text);
  const std::vector<PlanOfWorlds> plans = MakeContingentPlan(worlds, {}, {}).plans;
  for (const std::string name :
       {"7",      "2nd",   "a--b",   "on-",  "dx",     "pose",   "types",         "goal", "init",
        "action", "not",   "true",   "some", "within", "number", "step",          "K",    "add",
        "extern", "moved", "forall", "peg",  "block",  "lying",  "plan1-action_1"}) {
    SCOPED_TRACE(name);
    std::vector<domain::Problem> renamed = worlds;
    for (domain::Problem& world : renamed) {
      domain::OpenPose& open = world.open_poses.front();
      world.parts[static_cast<std::size_t>(open.part.index())].name = name;
      open.names.back() = name == "lying" ? "standing" : name;
    }
    const PlanKnowledge knowledge = KnowledgeOf(renamed, plans);
    const contingent::GroundTask task = ReadBack(knowledge);
    Budget budget(1'000);
    const auto plan = contingent::MakePlan(task, contingent::Wanted::kFirst, budget);
    ASSERT_EQ(plan.outcome, Outcome::kFound);
    EXPECT_TRUE(contingent::CheckTree(task, plan.tree).holds);
    std::multiset<std::string> named;
    for (const auto& [constant, of] : knowledge.names) named.insert(of);
    EXPECT_EQ(named,
              (std::multiset<std::string>{name, "lying", renamed[1].open_poses[0].names[1]}));
  }
}

}  // namespace
}  // namespace assay::assembly::contingent_assembly_test
