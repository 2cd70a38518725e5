#include "planner/contingent/search/goal_conflict.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <vector>

#include "planner/base/random.h"
#include "planner/contingent/grounding/ground_query.h"
#include "planner/contingent/search/contingent_planner.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "tests/planner/contingent/tasks.h"

namespace assay::contingent::goal_conflict_test {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> TextsOf(const GroundTask& task, const GoalConflict& conflict) {
  std::vector<std::string> texts;
  for (const GroundQuery& part : conflict.parts) texts.push_back(TextOf(task, part));
  return texts;
}

GoalConflict ConflictOf(const GroundTask& task) {
  Budget budget(100'000);
  return FindGoalConflict(task, budget);
}

TEST(GoalConflict, NamesThePartsThatExcludeEachOther) {
  const GroundTask task = GroundText(
      "domain d predicates: p, q, r\n"
      "action left effects: add(Kf, p), add(Kf, !q)\n"
      "action right effects: add(Kf, q), add(Kf, !p)\n"
      "action other effects: add(Kf, r)\n",
      "problem d domain d init: add(Kf, !p), add(Kf, !q), add(Kf, !r) goal: K(p) & K(r) & K(q)");
  EXPECT_EQ(PlanFor(task, Wanted::kFirst).outcome, Outcome::kNone);
  const GoalConflict conflict = ConflictOf(task);
  EXPECT_THAT(TextsOf(task, conflict), ElementsAre("K(p)", "K(q)"));
  EXPECT_TRUE(conflict.is_minimal);
}

TEST(GoalConflict, NamesThePartThatNothingReaches) {
  const GroundTask task =
      GroundText("domain d predicates: p, q action a effects: add(Kf, p)\n",
                 "problem d domain d init: add(Kf, !p) goal: K(p) & (K(q) | K(!q))");
  const GoalConflict conflict = ConflictOf(task);
  ASSERT_EQ(conflict.parts.size(), 1);
  EXPECT_EQ(TextOf(task, conflict.parts.front()), "K(q) | K(!q)");
  EXPECT_TRUE(conflict.is_minimal);
}

// The oracle asks for a plan for every set of parts of the goal.
TEST(GoalConflict, IsASmallestOneOfItsSetInRandomTasks) {
  const std::vector<std::string> atoms = {"p", "q", "r", "s"};
  int conflicts = 0;
  for (int seed = 1; seed <= 150; ++seed) {
    RandomStream random(seed, "goal conflict");
    const auto literal = [&] { return (random.Index(2) == 0 ? "!" : "") + atoms[random.Index(4)]; };
    std::string domain = "domain d predicates: p, q, r, s\n";
    for (int a = 0; a < 3; ++a) {
      domain += fmt::format("action a{} preconds: K({}) effects: add(Kf, {}), add(Kf, {})\n", a,
                            literal(), literal(), literal());
    }
    const GroundTask task = GroundText(
        domain, fmt::format("problem d domain d init: add(Kf, {}), add(Kf, {}) "
                            "goal: K({}) & K({}) & K({}) & Kw({})",
                            "p", "!q", literal(), literal(), literal(), atoms[random.Index(4)]));
    if (PlanFor(task, Wanted::kFirst).outcome != Outcome::kNone) continue;
    SCOPED_TRACE(fmt::format("seed {}\n{}", seed, domain));
    const GoalConflict conflict = ConflictOf(task);
    EXPECT_TRUE(conflict.is_minimal);
    ASSERT_FALSE(conflict.parts.empty());
    const unsigned all = (1U << conflict.parts.size()) - 1;
    for (unsigned chosen = 0; chosen <= all; ++chosen) {
      GroundTask reduced = task;
      std::vector<GroundQuery> parts;
      for (std::size_t i = 0; i < conflict.parts.size(); ++i) {
        if ((chosen >> i & 1U) != 0) parts.push_back(conflict.parts[i]);
      }
      reduced.goal = Joined(GroundQuery::Kind::kAnd, parts);
      EXPECT_EQ(PlanFor(reduced, Wanted::kLeastDepth).outcome,
                chosen == all ? Outcome::kNone : Outcome::kFound);
    }
    ++conflicts;
  }
  EXPECT_GT(conflicts, 20);
}

// p is decided by a number of which only the range is known. The planner does not record which
// number decides p, so that it cannot rule out that sensing the number reveals p.
TEST(NoPlan, IsNotSaidWhereMoreMayBeKnownThanIsKept) {
  const GroundTask task = GroundText(
      "domain d functions: n: number predicates: p, done\n"
      "action decide preconds: !K(done) effects: K(n > 2) => add(Kf, p); K(n <= 2) => add(Kf, "
      "!p);\n"
      "  add(Kf, done)\n"
      "action look preconds: K(done) effects: add(Kw, n > 2)\n",
      "problem d domain d init: add(Kf, n = [0, 3]), add(Kf, !done) goal: Kw(p)");
  const ContingentPlan plan = PlanFor(task, Wanted::kFirst);
  EXPECT_NE(plan.outcome, Outcome::kNone);
  EXPECT_EQ(plan.outcome == Outcome::kBudget, !plan.doubt.empty());
}

// A plan must wait before it branches on p to take the action `first`. The planner branches on p as
// soon as it is sensed.
TEST(NoPlan, IsNotSaidWhereABranchMightHaveWaited) {
  const GroundTask task = GroundText(
      "domain d predicates: p, q, r\n"
      "action look effects: add(Kw, p), add(Kf, r)\n"
      "action first preconds: K(r) & !K(p) & !K(!p) effects: add(Kf, q)\n",
      "problem d domain d init: add(Kf, !q), add(Kf, !r) goal: K(q)");
  const ContingentPlan plan = PlanFor(task, Wanted::kLeastDepth);
  const PlanTree waiting = {.nodes = {ActOf(task, "look", 1), ActOf(task, "first", 2), PlanNode{}},
                            .root = NodeId(0)};
  EXPECT_EQ(CheckTree(task, waiting).failure, "");
  EXPECT_EQ(plan.outcome, Outcome::kBudget);
  EXPECT_NE(plan.doubt, "");
}

// A plan may branch on the value of f, or on whether n is above 2. The planner would need Kx or Kw.
TEST(NoPlan, IsNotSaidWhereAPlanMightBranchOnASensedValue) {
  const std::string actions = "action look effects: add(Kv, f), add(Kv, n)\n";
  const std::string problem = "problem p domain d init: add(Kf, !g) goal: K(g)";
  const std::string domain =
      "domain d types: c predicates: g functions: f: c, n: number constants: a, b: c\n";
  for (const char* asked : {"f = a", "n > 2"}) {
    const GroundTask task =
        GroundText(fmt::format("{}{}action if preconds: K({}) effects: add(Kf, g)\n"
                               "action else preconds: K(!({})) effects: add(Kf, g)\n",
                               domain, actions, asked, asked),
                   problem);
    const ContingentPlan plan = PlanFor(task, Wanted::kFirst);
    EXPECT_EQ(plan.outcome, Outcome::kBudget) << asked;
    EXPECT_THAT(plan.doubt, testing::HasSubstr("the sensed value of")) << asked;
  }
}

// Without the second action, a world with another value of f has no way to the goal.
TEST(NoPlan, IsSaidWhereOneSensedValueIsHopeless) {
  const GroundTask task = GroundText(
      "domain d types: c predicates: g functions: f: c constants: a, b: c\n"
      "action look effects: add(Kv, f)\n"
      "action if preconds: K(f = a) effects: add(Kf, g)\n",
      "problem p domain d init: add(Kf, !g) goal: K(g)");
  const ContingentPlan plan = PlanFor(task, Wanted::kFirst);
  EXPECT_EQ(plan.outcome, Outcome::kNone);
  EXPECT_EQ(plan.doubt, "");
}

}  // namespace
}  // namespace assay::contingent::goal_conflict_test
