#include "planner/contingent/plan_tree/tree_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "planner/base/random.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "tests/planner/contingent/tasks.h"

namespace assay::contingent::tree_file_test {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

PlanTree Read(const Json& json, const GroundTask& task) {
  return ReadTree(Document::Parse(json.dump(), "tree.json").root(), task);
}

TEST(TreeFile, RepeatsAreReadBack) {
  const GroundTask task = GroundScenario("slippery-grasp", "hold-the-cup");
  PlanTree tree = PlanFor(task, Wanted::kFirst).tree;
  EXPECT_EQ(Read(ToJson(task, tree), task).nodes, tree.nodes);
  for (PlanNode& node : tree.nodes) {  // both outcomes lead back to the same node
    if (node.repeats.empty()) continue;
    node.children[0] = node.children[1];
    node.repeats = {true, true};
  }
  EXPECT_EQ(Read(ToJson(task, tree), task).nodes, tree.nodes);
}

TEST(TreeFile, RepeatsGoBackToNodesAbove) {
  const GroundTask task = GroundScenario("slippery-grasp", "hold-the-cup");
  const Json look = {{"name", "tryToGrasp"}, {"arguments", {"cup"}}};
  const Json branch = {{"branch", "holding(cup)"}, {"true", 2}, {"false", 0}, {"repeats", {0, 2}}};
  const Json tree = {{"format", "assay-tree/1"},
                     {"root", 0},
                     {"nodes", {{{"act", look}, {"then", 1}}, branch, {{"goal", true}}}}};
  EXPECT_THAT(MessageOf([&] { Read(tree, task); }),
              HasSubstr("a repeat of node 2, which is not an ancestor on every way"));
}

class HandWritten : public testing::Test {
 protected:
  // Returns a tree in which a look senses a & b, followed by this branch and this goal.
  Json Tree(const Json& branch, const Json& goal = {{"goal", true}}) const {
    const Json look = {{"name", "look"}, {"arguments", Json::array()}};
    return {{"format", "assay-tree/1"},
            {"root", 0},
            {"nodes", {{{"act", look}, {"then", 1}}, branch, goal}}};
  }
  static Json Branch(const std::string& formula) {
    return {{"branch", formula}, {"true", 2}, {"false", 2}};
  }
  std::string Message(const Json& tree) const {
    return MessageOf([&] { Read(tree, task_); });
  }

  const GroundTask task_ =
      GroundText("domain d predicates: a, b action look effects: add(Kw, a & b)",
                 "problem p domain d goal: Kw(a & b)");
};

TEST_F(HandWritten, AConjunctionIsOneInWhateverOrder) {
  const PlanTree tree = Read(Tree(Branch("a & b")), task_);
  EXPECT_EQ(Read(Tree(Branch("b & a")), task_).nodes, tree.nodes);
  EXPECT_TRUE(CheckTree(task_, tree).holds);
  EXPECT_THAT(Message(Tree(Branch("a"))), HasSubstr("nothing senses 'a'"));
  EXPECT_THAT(Message(Tree(Branch("a & b & c"))), HasSubstr("nothing senses 'a & b & c'"));
}

TEST_F(HandWritten, AnotherFormatIsRefused) {
  Json tree = Tree(Branch("a & b"));
  tree["format"] = "assay-tree/2";
  EXPECT_THAT(Message(tree), HasSubstr("'assay-tree/2'"));
  EXPECT_THAT(Message(tree), HasSubstr("allowed: assay-tree/1"));
}

TEST_F(HandWritten, ANodeIsOfOneKind) {
  Json both = Branch("a & b");
  both["then"] = 2;
  EXPECT_THAT(Message(Tree(both)), HasSubstr("unknown key 'then'"));
  EXPECT_THAT(Message(Tree(Branch("a & b"), {{"goal", false}})),
              HasSubstr("'goal' is false; allowed: true"));
  EXPECT_THAT(Message(Tree(Branch("a & b"), {{"goal", true}, {"then", 0}})),
              HasSubstr("unknown key 'then'"));
  EXPECT_THAT(Message(Tree(Branch("a & b"), {{"gaol", true}})),
              HasSubstr("unknown key 'gaol'; did you mean 'goal'?"));
}

TEST_F(HandWritten, AnActionThatIsNotThereIsTold) {
  Json tree = Tree(Branch("a & b"));
  tree["nodes"][0]["act"]["name"] = "lok";
  EXPECT_THAT(Message(tree), HasSubstr("'lok'; did you mean 'look'?; allowed: look"));
  tree["nodes"][0]["act"] = {{"name", "look"}, {"arguments", {"a"}}};
  EXPECT_THAT(Message(tree), HasSubstr("no action look(a); allowed: look of other arguments"));
}

// Returns whether a node is reached from the root by children that are no repeats and without
// passing `without`.
bool IsReached(const PlanTree& tree, NodeId from, NodeId to, NodeId without) {
  if (from == without) return false;
  if (from == to) return true;
  const PlanNode& node = tree.node(from);
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    if (!node.Repeats(i) && IsReached(tree, node.children[i], to, without)) return true;
  }
  return false;
}

bool DoAllRepeatsGoBack(const PlanTree& tree) {
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    for (std::size_t i = 0; i < tree.nodes[n].children.size(); ++i) {
      const bool repeats = tree.nodes[n].Repeats(i);
      if (repeats && IsReached(tree, tree.root, NodeId(n), tree.nodes[n].children[i])) return false;
    }
  }
  return true;
}

TEST(TreeFile, RepeatsGoBackOnEveryWay) {
  const GroundTask task = GroundScenario("slippery-grasp", "hold-the-cup");
  int refused = 0;
  int read = 0;
  for (int trial = 0; trial < 2'000; ++trial) {
    RandomStream random(trial, "repeats");
    const int count = 2 + random.Index(7);
    PlanTree tree = {.nodes = std::vector<PlanNode>(count), .root = NodeId(0)};
    for (int n = 0; n + 1 < count; ++n) {
      PlanNode& node = tree.nodes[n];
      node.kind = PlanNode::Kind::kWhether;
      node.formula = FormulaId(0);
      for (int child = 0; child < 2; ++child) {
        const bool repeats = random.Index(4) == 0;
        node.children.push_back(
            NodeId(repeats ? random.Index(count - 1) : n + 1 + random.Index(count - 1 - n)));
        node.repeats.push_back(repeats);
      }
      // The file has one number for both children, so that both or none are repeats.
      if (node.children[0] == node.children[1]) node.repeats[0] = node.repeats[1];
    }
    const std::string message = MessageOf([&] { Read(ToJson(task, tree), task); });
    ASSERT_EQ(message == "no error", DoAllRepeatsGoBack(tree)) << message;
    ++(message == "no error" ? read : refused);
  }
  EXPECT_GT(std::min(read, refused), 200);
}

// The test redirects each edge of a plan tree to every node, once as a repeat and once not. Each
// changed file is refused, or its tree is checked to the end.
TEST(TreeFile, ChildrenThatLeadElsewhereAreTold) {
  for (const auto& [domain, problem] :
       {std::pair("slippery-grasp", "hold-the-cup"), std::pair("pouring", "half-full-jug"),
        std::pair("opening-a-safe", "safe-by-trial")}) {
    const GroundTask task = GroundScenario(domain, problem);
    const PlanTree right = PlanFor(task, Wanted::kFirst).tree;
    for (std::size_t n = 0; n < right.nodes.size(); ++n) {
      for (std::size_t child = 0; child < right.nodes[n].children.size(); ++child) {
        for (std::size_t to = 0; to < 2 * right.nodes.size(); ++to) {
          PlanTree wrong = right;
          PlanNode& node = wrong.nodes[n];
          node.children[child] = NodeId(to / 2);
          node.repeats.resize(node.children.size(), false);
          node.repeats[child] = to % 2 == 1;
          try {
            const PlanTree read = Read(ToJson(task, wrong), task);
            EXPECT_EQ(CheckTree(task, read).holds, CheckTree(task, read).failure.empty());
            EXPECT_FALSE(TextOf(task, read, Sharing::kOnce).empty());
          } catch (const InputError&) {
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace assay::contingent::tree_file_test
