#include "planner/contingent/tree_check/tree_check.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/contingent/tree_check/symbolic_check.h"
#include "planner/contingent/world_sets/initial_worlds.h"
#include "planner/contingent/world_sets/world_progression.h"
#include "tests/planner/contingent/tasks.h"

namespace assay::contingent::tree_check_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Trees that were made by hand, in which the checker must find the errors.
class Lamp : public testing::Test {
 protected:
  ActionId Action(const std::string& name) const {
    for (std::size_t a = 0; a < task_.actions.size(); ++a) {
      if (task_.actions[a].name == name) return ActionId(a);
    }
    return ActionId::None();
  }

  // Adds a node that continues with nodes that were added before.
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
  EXPECT_TRUE(check.AreAllWorlds());
  EXPECT_THAT(check.unreached, IsEmpty());
}

// The tree is as deep as a file can make it. A recursive check, one by one or by sets, would
// overflow the stack.
TEST_F(Lamp, LongPlansAreRun) {
  NodeId next = Goal();
  next = Act("look", Branch(next, Act("press", next)));
  for (int i = 0; i < 200'000; ++i) next = Act("look", next);
  const TreeCheck check = Check();
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_EQ(check.worlds, 2);
  EXPECT_TRUE(CheckBySets(task_, tree_)->holds);
  EXPECT_EQ(SizeOf(tree_).depth, 200'002);
}

TEST_F(Lamp, BranchesInEachOtherAreRun) {
  const NodeId goal = Goal();
  const NodeId press = Act("press", goal);
  NodeId next = goal;
  for (int i = 0; i < 100'000; ++i) next = Branch(next, press);
  Act("look", next);
  const TreeCheck check = Check();
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_EQ(check.worlds, 2);
  EXPECT_TRUE(CheckBySets(task_, tree_)->holds);
  EXPECT_EQ(SizeOf(tree_).nesting, 100'000);
}

// At each node the lamp is either lit and shaken again, or not lit and pressed.
TEST_F(Lamp, BranchesThatTellWorldsApartInEachOtherAreRun) {
  const NodeId goal = Goal();
  const NodeId press = Act("press", goal);
  NodeId next = Act("look", Branch(goal, press));
  for (int i = 0; i < 30'000; ++i) next = Act("look", Branch(Act("shake", next), press));
  const TreeCheck check = Check();
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_EQ(check.worlds, 30'002);
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
  EXPECT_THAT(Check().unreached, SizeIs(1));  // the press in the lit case is never reached
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

// Each repeat ends when the lamp is lit, which is then shaken for the next repeat. There are as
// many as a file can have.
TEST_F(Lamp, RepeatsOneAfterAnotherAreRun) {
  NodeId next = Goal();
  for (int i = 0; i < 20'000; ++i) {
    const NodeId branch = Branch(i == 0 ? next : Act("shake", next), next);
    next = Act("kick", branch);
    tree_.nodes[branch.index()].children[1] = next;
    tree_.nodes[branch.index()].repeats = {false, true};
  }
  const TreeCheck check = Check();
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_EQ(SizeOf(tree_).repeats, 20'000);
  // In this variant the first repeat, which was added last, only looks and never lights the lamp.
  tree_.nodes[tree_.root.index()].action = Action("look");
  EXPECT_THAT(Check().failure, HasSubstr("a repeat without end after look(); branch !lit"));
}

// There are two nested loops and one after them. The nodes of a loop lead to each other.
TEST_F(Lamp, LoopsAreWhatRepeatsLeadRound) {
  const NodeId goal = Goal();
  const NodeId behind = Branch(goal, goal);
  tree_.nodes[behind.index()].children[1] = behind;
  const NodeId inner = Branch(behind, goal);
  const NodeId outer = Act("look", inner);
  const NodeId root = Act("shake", outer);
  tree_.nodes[inner.index()].children = {behind, outer};
  const std::vector<LoopId> loops = LoopsOf(tree_);
  EXPECT_EQ(loops[inner.index()], loops[outer.index()]);
  for (const NodeId alone : {goal, behind, root}) {
    EXPECT_EQ(std::ranges::count(loops, loops[alone.index()]), 1);
  }
}

TEST_F(Lamp, ARepeatMustBeginAgainWhereItBegan) {
  const NodeId goal = Goal();
  const NodeId branch = Branch(goal, goal);
  const NodeId smash = Act("smash", branch);
  const NodeId look = Act("look", branch);
  tree_.nodes[branch.index()].children[1] = smash;  // the lamp is broken only from here on
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
  tree_.nodes[branch.index()].children[1] = look;  // looking does not light the lamp
  tree_.nodes[branch.index()].repeats = {false, true};
  EXPECT_FALSE(Check().holds);
}

PlanNode Repeating(PlanNode node, std::size_t child) {
  node.repeats.resize(node.children.size(), false);
  node.repeats[child] = true;
  return node;
}

// Returns a task that counts looks, beginning with the value in `init`.
GroundTask Counting(const std::string& init) {
  return GroundText(
      "domain count predicates: lit, broken functions: looks: number\n"
      "action look effects: add(Kw, lit), add(Kf, looks = looks + [1, 1])\n"
      "action flicker effects: del(Kf, lit), add(Kw, lit)\n",
      "problem count domain count init: " + init + " goal: K(lit)");
}

// The rounds never end, and each has a new number.
TEST(Repeats, ThatCountForEverAreTold) {
  const GroundTask task = Counting("add(Kf, !broken)");
  const PlanTree tree = {
      .nodes = {ActOf(task, "look", 1), Repeating(BranchOf(task, "lit", 2, 0), 1), PlanNode{}},
      .root = NodeId(0)};
  EXPECT_THAT(CheckTree(task, tree).failure, HasSubstr("a repeat without end after look()"));
}

// The first outcome goes back unchanged. The second outcome counts and is met on the way.
TEST(Repeats, ThatCountElsewhereAreTold) {
  const GroundTask task = Counting("add(Kf, looks = 0)");
  const PlanTree tree = {
      .nodes = {ActOf(task, "flicker", 1), Repeating(BranchOf(task, "lit", 0, 2), 0),
                Repeating(ActOf(task, "look", 0), 0)},
      .root = NodeId(0)};
  EXPECT_THAT(CheckTree(task, tree).failure, HasSubstr("a repeat begins in another world"));
}

// After a press the lamp must be looked at again, although each world is one with which the repeat
// began.
TEST(Repeats, MustHaveSensedWhatIsAskedBelow) {
  const GroundTask task = GroundText(
      "domain lamp predicates: lit, bell\n"
      "action look effects: add(Kw, lit)\n"
      "action press effects: K(lit) => add(Kf, !lit); K(!lit) => add(Kf, lit)\n"
      "action ring effects: del(Kf, bell), add(Kw, bell)\n",
      "problem lamp domain lamp init: add(Kf, !bell) goal: K(lit)");
  PlanTree tree = {
      .nodes = {ActOf(task, "look", 1), ActOf(task, "ring", 2), BranchOf(task, "bell", 3, 5),
                BranchOf(task, "lit", 4, 7), PlanNode{}, Repeating(ActOf(task, "press", 1), 0),
                Repeating(ActOf(task, "look", 1), 0), ActOf(task, "press", 4)},
      .root = NodeId(0)};
  EXPECT_THAT(CheckTree(task, tree).failure,
              HasSubstr("a branch on lit, which has not been sensed, after look()"));
  tree.nodes[5] = ActOf(task, "press", 6);
  EXPECT_EQ(CheckTree(task, tree).failure, "");
}

// ---- Queries of what is unknown

constexpr const char* kBell =
    "domain bell predicates: p, q, g, ok\n"
    "action look effects: add(Kw, p)\n"
    "action guess preconds: !Kw(p) effects: add(Kf, g)\n"
    "action doubt effects: !K(p) => add(Kf, g)\n"
    "action note effects: !Kw(p) => add(Kf, !ok); add(Kf, g)\n"
    "action kick effects: del(Kf, q), add(Kw, q)\n"
    "action lose effects: add(Kf, !p)\n";

GroundTask Bell(const std::string& init, const std::string& goal) {
  return GroundText(kBell, "problem bell domain bell init: " + init + " goal: " + goal);
}

TEST(NotKnown, EffectsDoNotHappenWhereItIsKnown) {
  GroundTask task = Bell("add(Kf, p), add(Kf, !g)", "K(g)");
  const PlanTree doubt = {.nodes = {ActOf(task, "doubt", 1), PlanNode{}}, .root = NodeId(0)};
  EXPECT_THAT(CheckTree(task, doubt).failure, HasSubstr("the goal is not known after doubt()"));
  task = Bell("add(Kf, !g)", "K(g)");
  EXPECT_EQ(CheckTree(task, doubt).failure, "");
  task = Bell("add(Kf, p), add(Kf, g)", "K(g)");
  EXPECT_EQ(CheckTree(task, doubt).failure, "");
}

TEST(NotKnown, IsAskedAfterBranches) {
  const GroundTask task = Bell("add(Kf, ok), add(Kf, !g)", "K(g) & K(ok)");
  const PlanTree after = {.nodes = {ActOf(task, "look", 1), BranchOf(task, "p", 2, 2),
                                    ActOf(task, "note", 3), PlanNode{}},
                          .root = NodeId(0)};
  EXPECT_EQ(CheckTree(task, after).failure, "");
  const PlanTree before = {.nodes = {ActOf(task, "note", 1), PlanNode{}}, .root = NodeId(0)};
  EXPECT_THAT(CheckTree(task, before).failure, HasSubstr("the goal is not known after note()"));
}

TEST(NotKnown, IsAskedByPreconditions) {
  const GroundTask task = Bell("add(Kf, !g)", "K(g)");
  const PlanTree known = {.nodes = {ActOf(task, "look", 1), BranchOf(task, "p", 2, 2),
                                    ActOf(task, "guess", 3), PlanNode{}},
                          .root = NodeId(0)};
  EXPECT_THAT(CheckTree(task, known).failure,
              HasSubstr("the precondition of guess() is not known after look()"));
  const PlanTree guessed = {.nodes = {ActOf(task, "guess", 1), PlanNode{}}, .root = NodeId(0)};
  EXPECT_EQ(CheckTree(task, guessed).failure, "");
}

TEST(NotKnown, IsAskedByGoals) {
  const PlanTree nothing = {.nodes = {PlanNode{}}, .root = NodeId(0)};
  EXPECT_THAT(CheckTree(Bell("add(Kf, p), add(Kf, !g)", "!K(p) & K(!g)"), nothing).failure,
              HasSubstr("the goal is not known after no step"));
  EXPECT_EQ(CheckTree(Bell("add(Kf, !g)", "!K(p) & K(!g)"), nothing).failure, "");
}

TEST(NotKnown, IsAskedByUpdateRules) {
  const auto task = [](const std::string& init) {
    return GroundText(
        "domain rule predicates: p, ok action wait effects: add(Kf, ok)\n"
        "updates: !K(p) => add(Kf, !ok)",
        "problem rule domain rule init: " + init + " goal: K(ok)");
  };
  const PlanTree tree = {.nodes = {ActOf(task("add(Kf, p)"), "wait", 1), PlanNode{}},
                         .root = NodeId(0)};
  EXPECT_EQ(CheckTree(task("add(Kf, p)"), tree).failure, "");
  EXPECT_FALSE(CheckTree(task("add(Kf, ok)"), tree).holds);
}

// Facts that were looked at are still known when the repeat begins again.
TEST(NotKnown, IsAskedAgainByRepeats) {
  const GroundTask task = Bell("add(Kf, !g)", "K(q)");
  PlanTree tree = {
      .nodes = {ActOf(task, "guess", 1), ActOf(task, "look", 2), BranchOf(task, "p", 3, 3),
                ActOf(task, "kick", 4), Repeating(BranchOf(task, "q", 5, 0), 1), PlanNode{}},
      .root = NodeId(0)};
  EXPECT_THAT(CheckTree(task, tree).failure, HasSubstr("the precondition of guess() is not known"));
  tree.nodes[4] = Repeating(BranchOf(task, "q", 5, 3), 1);
  EXPECT_EQ(CheckTree(task, tree).failure, "");
}

// Only one of many worlds comes back to the repeat. It is not known that the true world is this
// one.
TEST(NotKnown, IsAskedOfAllWorldsThatGoRound) {
  const GroundTask task = Bell("add(Kf, !g)", "K(q)");
  const PlanTree tree = {.nodes = {ActOf(task, "guess", 1), ActOf(task, "kick", 2),
                                   Repeating(BranchOf(task, "q", 3, 0), 1), PlanNode{}},
                         .root = NodeId(0)};
  EXPECT_EQ(CheckTree(task, tree).failure, "");
}

// The drawn worlds differ in p. After a branch on p, the drawn worlds that remain may share a fact
// that is not true in all worlds.
TEST(NotKnown, IsNotToldByDrawnWorlds) {
  const GroundTask task =
      GroundText("domain draw predicates: p, q, r, g action doubt effects: !K(p) => add(Kf, g)",
                 "problem draw domain draw init: add(Kx, p | q | r) goal: K(g)");
  const PlanTree tree = {.nodes = {ActOf(task, "doubt", 1), PlanNode{}}, .root = NodeId(0)};
  EXPECT_TRUE(CheckTree(task, tree).holds);
  const auto drawn_p = [&](std::uint64_t seed) {
    const World world = EnumerateWorlds(task, NumberMarks(task, tree), 1, seed).worlds.front();
    return WorldProgression::IsTrue(task.initial.relations.front().literals.front(), world);
  };
  std::uint64_t seed = 1;
  while (!drawn_p(seed)) ++seed;
  EXPECT_THAT(CheckTree(task, tree, {.worlds = 1, .seed = seed}).failure,
              HasSubstr("worlds that are drawn cannot decide this"));
}

// There are 2^20 worlds by the places of the cans. Nothing tells whether a can is full before it is
// weighed.
TEST(NotKnown, IsToldBySets) {
  std::string cans = "can0";
  std::string init = "add(Kx, here(can0) | there(can0))";
  for (int i = 1; i < 20; ++i) {
    cans += fmt::format(", can{}", i);
    init += fmt::format(", add(Kx, here(can{0}) | there(can{0}))", i);
  }
  const GroundTask task = GroundText(
      "domain cans types: can predicates: full(can), told(can), here(can), there(can)\n"
      "action weigh(?c: can) preconds: !Kw(full(?c)) effects: add(Kw, full(?c)), add(Kf, told(?c))",
      "problem cans domain cans objects: " + cans + ": can init: " + init +
          " goal: forallK(?c: can) K(told(?c))");
  PlanTree tree = PlanFor(task, Wanted::kFirst).tree;
  const TreeCheck check = CheckTree(task, tree);
  EXPECT_EQ(check.failure, "");
  EXPECT_TRUE(check.AreAllWorlds());
  EXPECT_EQ(check.worlds, 1 << 20);
  // In this variant the same can is weighed again and again.
  for (PlanNode& node : tree.nodes) {
    if (node.kind == PlanNode::Kind::kAct) node.action = tree.node(tree.root).action;
  }
  EXPECT_FALSE(CheckBySets(task, tree)->holds);
}

// If a number n decides p, or p decides q, then sensing reveals the decided fact. No plan may claim
// that the fact is unknown, and the planner does not find that it is known.
TEST(NotKnown, IsNotSaidOfWhatNumbersTell) {
  const auto outcome = [](const std::string& actions, const std::string& asked) {
    const GroundTask task = GroundText(
        "domain n predicates: p, q, r, first, second, looked, g functions: n: number, m: number\n" +
            actions + "action finish preconds: K(looked) & !Kw(" + asked +
            ") effects: add(Kf, g)\n",
        "problem n domain n\n"
        "init: add(Kf, n = [0, 5]), add(Kf, m = 0), add(Kf, !q), add(LCW, first),\n"
        "  add(LCW, second), add(LCW, looked), add(LCW, g)\n"
        "goal: K(g)");
    const ContingentPlan plan = PlanFor(task, Wanted::kLeastDepth);
    if (plan.outcome == Outcome::kFound) {
      EXPECT_EQ(CheckTree(task, plan.tree).failure, "");
    }
    return plan.outcome;
  };
  // A number that p itself has set reveals p.
  EXPECT_EQ(outcome("action set effects: K(p) => add(Kf, m = 5); add(Kf, first)\n"
                    "action look preconds: K(first) effects: add(Kf, looked), add(Kw, m > 2)\n",
                    "p"),
            Outcome::kBudget);
  // Another atom that the same number decided reveals q.
  const std::string deciding =
      "action decide effects: K(n > 2) => add(Kf, q); add(Kf, first)\n"
      "action decideAgain preconds: K(first)\n"
      "  effects: K(n > 2) => add(Kf, p); K(n <= 2) => add(Kf, !p); add(Kf, second)\n";
  EXPECT_EQ(outcome(deciding + "action look preconds: K(second)\n"
                               "  effects: add(Kf, looked), add(Kw, p)\n",
                    "q"),
            Outcome::kBudget);
  // The number decided p, which decided q and was then overwritten. Sensing the number reveals q.
  EXPECT_EQ(outcome("action decide effects: K(n > 2) => add(Kf, p); K(n <= 2) => add(Kf, !p);\n"
                    "  add(Kf, first)\n"
                    "action swap preconds: K(first) effects: K(p) => add(Kf, q);\n"
                    "  K(!p) => add(Kf, !q); K(r) => add(Kf, p); K(!r) => add(Kf, !p);\n"
                    "  add(Kf, second)\n"
                    "action look preconds: K(second) effects: add(Kf, looked), add(Kw, n > 2)\n",
                    "q"),
            Outcome::kBudget);
  // The sensed atom does not depend on a number that decides q.
  EXPECT_EQ(outcome(deciding + "action look preconds: K(first)\n"
                               "  effects: add(Kf, looked), add(Kw, p)\n",
                    "q"),
            Outcome::kFound);
}

// One number decides two effects. For every value of the number, f is b after both actions.
TEST(NotKnown, IsNotSaidOfValuesThatNumbersDecide) {
  const GroundTask task = GroundText(
      "domain n types: thing constants: b, c: thing predicates: r\n"
      "functions: f: thing, n: number\n"
      "action lose effects: K(n > 2) => del(Kf, r)\n"
      "action set effects: K(n > 1) | K(r) => add(Kf, f = b)\n",
      "problem n domain n init: add(Kf, r), add(Kf, f = c), add(Kf, n = [0, 3]) goal: !Kv(f)");
  const PlanTree tree = {.nodes = {ActOf(task, "lose", 1), ActOf(task, "set", 2), PlanNode{}},
                         .root = NodeId(0)};
  EXPECT_THAT(CheckTree(task, tree).failure, HasSubstr("the goal is not known"));
  EXPECT_EQ(PlanFor(task, Wanted::kLeastDepth).outcome, Outcome::kBudget);
}

// Kw(p & q) holds if sensing shows that not both atoms hold, although neither Kw(p) nor Kw(q)
// holds.
TEST(Conjunctions, AreKnownWhetherOrNotTheirAtomsAre) {
  const std::string domain =
      "domain alarm predicates: p, q, deaf, rings\n"
      "action listen preconds: !Kw(p & q) effects: add(Kw, p & q), add(Kf, rings)\n"
      "action ask preconds: Kw(p & q) & K(rings) & !Kw(p) effects: add(Kw, p)\n"
      "action hear preconds: K(!deaf) effects: add(Kx, some(!p | !q)), add(Kf, rings)\n";
  const auto check = [&](const std::vector<PlanNode>& nodes, const GroundTask& task) {
    return CheckTree(task, {.nodes = nodes, .root = NodeId(0)}).failure;
  };
  const auto task_of = [&](const std::string& deaf, const std::string& goal) {
    return GroundText(domain,
                      "problem alarm domain alarm init: add(Kf, " + deaf + ") goal: " + goal);
  };
  GroundTask task = task_of("!deaf", "Kw(p & q) & !Kw(p) & !Kw(q)");
  EXPECT_EQ(check({ActOf(task, "listen", 1), PlanNode{}}, task), "");
  EXPECT_EQ(check({ActOf(task, "hear", 1), PlanNode{}}, task), "");
  EXPECT_THAT(check({ActOf(task, "hear", 1), ActOf(task, "listen", 2), PlanNode{}}, task),
              HasSubstr("the precondition of listen() is not known"));
  EXPECT_THAT(check({PlanNode{}}, task), HasSubstr("the goal is not known"));
  // If not both hold and p holds, q does not.
  task = task_of("deaf", "K(p & q) | K(!p) | K(!q)");
  const ContingentPlan plan = PlanFor(task, Wanted::kLeastDepth);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_EQ(SizeOf(plan.tree).depth, 2);
  EXPECT_EQ(SizeOf(plan.tree).branch_points, 2);
  EXPECT_EQ(CheckTree(task, plan.tree).failure, "");
}

// The condition is that the level is above 3, known or not. Each world knows its level.
TEST(Effects, UnderBoundsHappenInEachWorld) {
  const auto check = [](const std::string& condition, const std::string& goal) {
    const GroundTask task = GroundText(
        "domain tank predicates: open, wet, done functions: level: number\n"
        "action drain effects: K(" +
            condition +
            ") => add(Kf, wet), add(Kf, level = 0);\n"
            "add(Kf, done)\n"
            "action look effects: add(Kw, open)",
        "problem tank domain tank init: add(Kf, level = [2, 5]), add(Kf, !wet) goal: " + goal);
    const TreeCheck tree_check =
        CheckTree(task, {.nodes = {ActOf(task, "drain", 1), PlanNode{}}, .root = NodeId(0)});
    EXPECT_TRUE(tree_check.AreAllWorlds());
    return tree_check.holds;
  };
  for (const char* condition : {"level > 3", "open & level > 3"}) {
    EXPECT_FALSE(check(condition, "K(done) & K(!wet)")) << condition;
    EXPECT_FALSE(check(condition, "K(done) & K(level >= 2)")) << condition;
    EXPECT_TRUE(check(condition, "K(done) & K(level <= 5)")) << condition;
  }
  EXPECT_TRUE(check("level > 3", "K(done) & K(level <= 3)"));
  EXPECT_FALSE(check("open & level > 3", "K(done) & K(level <= 3)"));
  EXPECT_TRUE(check("level >= 2", "K(wet) & K(level <= 0)"));
}

// There are three cases: at = a and p is false; at = b and q is false; or at is neither a nor b,
// and both p and q are true.
TEST(Worlds, HaveOneValueOfEachFunction) {
  const GroundTask task = GroundText(
      "domain at types: place constants: a, b, c: place predicates: p, q, done\n"
      "functions: at: place\n"
      "action look effects: add(Kw, at = b)\n"
      "action finish preconds: K(p) | K(at != b) effects: add(Kf, done)",
      "problem at domain at init: add(Kx, at = a | p), add(Kx, at = b | q) goal: K(done)");
  const PlanTree tree = {.nodes = {ActOf(task, "look", 1), BranchOf(task, "at = b", 2, 2),
                                   ActOf(task, "finish", 3), PlanNode{}},
                         .root = NodeId(0)};
  EXPECT_THAT(EnumerateWorlds(task, NumberMarks(task, tree), 100, 1).worlds, SizeIs(3));
  const TreeCheck check = CheckTree(task, tree);
  EXPECT_TRUE(check.holds) << check.failure;
}

TEST(NoWorld, HoldsNothing) {
  GroundTask task = GroundText(
      "domain n functions: n: number predicates: g action a effects: add(Kf, n <= 1), add(Kf, g)",
      "problem n domain n init: add(Kf, n = [2, 3]) goal: K(g)");
  const PlanTree tree = {.nodes = {ActOf(task, "a", 1), PlanNode{}}, .root = NodeId(0)};
  EXPECT_THAT(CheckTree(task, tree).failure,
              HasSubstr("what is known contradicts itself after a()"));
  EXPECT_EQ(PlanFor(task, Wanted::kFirst).outcome, Outcome::kNone);
  task.initial.ranges.front() = {.low = 3, .high = 2};
  EXPECT_THAT(CheckTree(task, tree).failure, HasSubstr("the initial knowledge allows no world"));
}

// Planner and checker know a value only within the error of the sensor.
TEST(ValuesSensedAtFirst, AreKnownWithinTheirErrors) {
  const PlanTree nothing = {.nodes = {PlanNode{}}, .root = NodeId(0)};
  const auto task = [](const std::string& goal) {
    return GroundText(
        "domain n functions: n: number action wait effects: add(Kf, n = n)",
        "problem n domain n init: add(Kf, n = [0, 3]), add(Kv, n within 0.5) goal: " + goal);
  };
  EXPECT_EQ(CheckTree(task("Kv(n within 0.5)"), nothing).failure, "");
  EXPECT_THAT(CheckTree(task("Kv(n within 0.1)"), nothing).failure,
              HasSubstr("the goal is not known after no step"));
  EXPECT_EQ(PlanFor(task("Kv(n within 0.5)"), Wanted::kFirst).outcome, Outcome::kFound);
  EXPECT_EQ(PlanFor(task("Kv(n within 0.1)"), Wanted::kFirst).outcome, Outcome::kNone);
}

// If there are too many worlds to run, they are checked as sets. The order of the nodes does not
// matter.
TEST(Worlds, AsSetsGoFromTheRootDown) {
  const GroundTask task = GroundScenario("bomb-in-the-toilet", "four-packages");
  const PlanTree tree = {.nodes = {ActOf(task, "dunk", 1), PlanNode{}}, .root = NodeId(0)};
  const TreeCheck check = CheckTree(task, tree, {.worlds = 1});
  EXPECT_FALSE(check.holds);
  EXPECT_THAT(check.failure, HasSubstr("the goal is not known"));
}

// The check by sets finds an error in one world of 2^30. Random worlds would hardly find it.
TEST(Worlds, AsSetsRefuteWhatIsWrongInOne) {
  std::string init = "add(Kf, !out)";
  for (int i = 0; i < 30; ++i) init += fmt::format(", add(Kx, left(l{0}) | right(l{0}))", i);
  std::string lamps = "l0";
  for (int i = 1; i < 30; ++i) lamps += fmt::format(", l{}", i);
  std::string all = "K(left(l0))";
  for (int i = 1; i < 30; ++i) all += fmt::format(" & K(left(l{}))", i);
  const GroundTask task = GroundText("domain lamps types: lamp constants: " + lamps +
                                         ": lamp predicates: left(lamp), right(lamp), out\n"
                                         "action press effects: " +
                                         all + " => add(Kf, out)",
                                     "problem lamps domain lamps init: " + init + " goal: K(!out)");
  const PlanTree tree = {.nodes = {ActOf(task, "press", 1), PlanNode{}}, .root = NodeId(0)};
  const TreeCheck check = CheckTree(task, tree, {.worlds = 1000});
  EXPECT_FALSE(check.holds);
  EXPECT_TRUE(check.AreAllWorlds());
  EXPECT_THAT(check.failure, HasSubstr("the goal is not known on some way of the tree, in the "
                                       "world with left(l0), left(l1), "));
}

// The level starts at 0 and increases twenty times by 1 to 2. There are very many ways to the
// integers from 20 to 40 and to the values just below and above them.
TEST(Worlds, ThatAreEqualAreOne) {
  const GroundTask task = GroundText(
      "domain pour functions: level: number action pour effects: add(Kf, level = level + [1, 2])",
      "problem pour domain pour init: add(Kf, level = 0) goal: K(level >= 20) & K(level <= 40)");
  PlanTree tree = {.nodes = {PlanNode{}}, .root = NodeId(20)};
  for (int i = 0; i < 20; ++i) tree.nodes.push_back(ActOf(task, "pour", i));
  const TreeCheck check = CheckTree(task, tree);
  EXPECT_EQ(check.failure, "");
  EXPECT_EQ(check.worlds, 61);
}

// For planner and checker, update rules run for more rounds than the task has atoms, or without
// end.
TEST(UpdateRules, CountUntilTheyRest) {
  const auto task = [](const std::string& rule) {
    return GroundText(
        "domain count predicates: done functions: f: number\n"
        "action go preconds: K(f >= 100) effects: add(Kf, done)\n"
        "action start effects: add(Kf, f = 0)\n"
        "updates: " +
            rule + " => add(Kf, f = f + 1)",
        "problem count domain count init: add(Kf, !done), add(Kf, f = -1) goal: K(done)");
  };
  const GroundTask counting = task("K(f >= 0) & K(f < 100)");
  const PlanTree tree = {
      .nodes = {ActOf(counting, "start", 1), ActOf(counting, "go", 2), PlanNode{}},
      .root = NodeId(0)};
  EXPECT_EQ(CheckTree(counting, tree).failure, "");
  EXPECT_EQ(SizeOf(PlanFor(counting, Wanted::kLeastDepth).tree).depth, 2);
  const GroundTask restless = task("K(f >= 0)");
  EXPECT_THAT(CheckTree(restless, tree).failure,
              HasSubstr("the update rules still change knowledge after"));
  EXPECT_THAT(MessageOf([&] { PlanFor(restless, Wanted::kLeastDepth); }),
              HasSubstr("the update rules still change knowledge after"));
}

// If there are more worlds than may be run, as many as allowed are drawn.
TEST(Worlds, AreDrawnIfTheyAreTooMany) {
  const GroundTask task = GroundScenario("unix", "find-a-file");
  const ContingentPlan plan = PlanFor(task, Wanted::kFirst);
  const TreeCheck all = CheckTree(task, plan.tree);
  EXPECT_TRUE(all.AreAllWorlds());
  EXPECT_EQ(all.worlds, 4);
  const TreeCheck some = CheckTree(task, plan.tree, {.worlds = 2});
  EXPECT_FALSE(some.AreAllWorlds());
  EXPECT_EQ(some.worlds, 2);
  EXPECT_TRUE(some.holds);
}

}  // namespace
}  // namespace assay::contingent::tree_check_test
