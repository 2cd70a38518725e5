#include "planner/contingent/tree_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planner/contingent/tasks.h"

namespace assay::contingent {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Trees by hand, of which the checker must tell what is wrong.
class Lamp : public testing::Test {
 protected:
  ActionId Action(const std::string& name) const {
    for (std::size_t a = 0; a < task_.actions.size(); ++a) {
      if (task_.actions[a].name == name) return ActionId(a);
    }
    return ActionId::None();
  }

  // A node that goes on with nodes that have been added before.
  NodeId Act(const std::string& name, NodeId then) {
    PlanNode node;
    node.kind = PlanNode::Kind::kAct;
    node.action = Action(name);
    node.children = {then};
    return Add(node);
  }
  NodeId Branch(NodeId if_true, NodeId if_false) {
    PlanNode node;
    node.kind = PlanNode::Kind::kWhether;
    node.formula = FormulaId(0);
    node.children = {if_true, if_false};
    return Add(node);
  }
  NodeId Goal() { return Add({}); }
  NodeId Add(PlanNode node) {
    tree_.nodes.push_back(std::move(node));
    tree_.root = NodeId(tree_.nodes.size() - 1);
    return tree_.root;
  }

  TreeCheck Check() const { return CheckTree(task_, tree_); }

  const GroundTask task_ = GroundText(
      "domain lamp predicates: lit, broken\n"
      "action look effects: add(Kw, lit)\n"
      "action press preconds: K(!broken) effects: K(lit) => add(Kf, !lit); K(!lit) => add(Kf, "
      "lit)\n"
      "action smash effects: add(Kf, !lit), add(Kf, broken)\n"
      "action shake effects: del(Kf, lit)\n"
      "action kick effects: del(Kf, lit), add(Kw, lit)\n",
      "problem lamp domain lamp init: add(Kf, !broken) goal: K(lit)");
  PlanTree tree_;
};

TEST_F(Lamp, ARightTreeHolds) {
  const NodeId goal = Goal();
  Act("look", Branch(goal, Act("press", goal)));
  const TreeCheck check = Check();
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_EQ(check.worlds, 2);
  EXPECT_TRUE(check.are_all_worlds);
  EXPECT_THAT(check.unreached, IsEmpty());
}

TEST_F(Lamp, TheGoalMustBeKnownAtLeaves) {
  Act("press", Goal());
  EXPECT_FALSE(Check().holds);
  EXPECT_THAT(Check().failure, HasSubstr("the goal is not known after press()"));
}

TEST_F(Lamp, BranchesOfATreeMayNotChangePlaces) {
  const NodeId goal = Goal();
  Act("look", Branch(Act("press", goal), goal));
  EXPECT_THAT(Check().failure, HasSubstr("the goal is not known"));
}

TEST_F(Lamp, ABranchMustHaveBeenSensed) {
  const NodeId goal = Goal();
  Branch(goal, Act("press", goal));
  EXPECT_THAT(Check().failure, HasSubstr("a branch on lit, which has not been sensed"));
}

TEST_F(Lamp, WhatWasSensedIsOutOfDateAfterAChange) {
  const NodeId goal = Goal();
  Act("look", Act("shake", Branch(goal, Act("press", goal))));
  EXPECT_THAT(Check().failure, HasSubstr("a branch on lit, which has not been sensed"));
}

TEST_F(Lamp, PreconditionsMustBeKnown) {
  Act("smash", Act("press", Goal()));
  EXPECT_THAT(Check().failure, HasSubstr("the precondition of press() is not known after smash()"));
}

TEST_F(Lamp, WhatIsForgottenMayBeEither) {
  const NodeId goal = Goal();
  Act("look", Branch(Act("shake", goal), Act("press", goal)));
  EXPECT_THAT(Check().failure, HasSubstr("the goal is not known"));
}

TEST_F(Lamp, UnreachedNodesAreReported) {
  const NodeId goal = Goal();
  Act("smash", Act("look", Branch(Act("press", goal), Act("look", goal))));
  EXPECT_FALSE(Check().holds);
  EXPECT_THAT(Check().unreached, SizeIs(1));  // press where lit: it never is
}

TEST_F(Lamp, ARepeatThatCanEndHolds) {
  const NodeId goal = Goal();
  const NodeId branch = Branch(goal, goal);
  const NodeId kick = Act("kick", branch);
  tree_.nodes[branch.index()].children[1] = kick;
  tree_.nodes[branch.index()].repeats = {false, true};
  const TreeCheck check = Check();
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_EQ(SizeOf(tree_).repeats, 1);
}

TEST_F(Lamp, ARepeatMustBeginAgainWhereItBegan) {
  const NodeId goal = Goal();
  const NodeId branch = Branch(goal, goal);
  const NodeId smash = Act("smash", branch);
  const NodeId look = Act("look", branch);
  tree_.nodes[branch.index()].children[1] = smash;  // broken only from then on
  tree_.nodes[smash.index()].children = {look};
  tree_.nodes[look.index()].repeats = {true};
  tree_.root = look;
  tree_.nodes[look.index()].repeats.clear();
  tree_.nodes[smash.index()].repeats = {true};
  EXPECT_THAT(Check().failure, HasSubstr("a repeat begins in another world"));
}

TEST_F(Lamp, ARepeatMustBeAbleToEnd) {
  const NodeId goal = Goal();
  const NodeId branch = Branch(goal, goal);
  const NodeId look = Act("look", branch);
  tree_.nodes[branch.index()].children[1] = look;  // looking lights no lamp
  tree_.nodes[branch.index()].repeats = {false, true};
  EXPECT_FALSE(Check().holds);
}

// More worlds than may be run: as many are drawn.
TEST(Worlds, AreDrawnIfTheyAreTooMany) {
  const GroundTask task = GroundScenario("unix", "find-a-file");
  const ContingentPlan plan = PlanFor(task, Wanted::kFirst);
  const TreeCheck all = CheckTree(task, plan.tree);
  EXPECT_TRUE(all.are_all_worlds);
  EXPECT_EQ(all.worlds, 4);
  const TreeCheck some = CheckTree(task, plan.tree, {.worlds = 2});
  EXPECT_FALSE(some.are_all_worlds);
  EXPECT_EQ(some.worlds, 2);
  EXPECT_TRUE(some.holds);
}

}  // namespace
}  // namespace assay::contingent
