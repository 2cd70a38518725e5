#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/contingent/tree_check/symbolic_check.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "planner/contingent/world_sets/initial_worlds.h"
#include "tests/oracle/world_set_search.h"
#include "tests/planner/contingent/tasks.h"

namespace assay::contingent::random_domains_test {
namespace {

constexpr int kAtoms = 4;
constexpr int kTrees = 1000;
constexpr int kDomains = 1000;
constexpr int kQuarters = 4;  // quarters run side by side
constexpr int kOraclesDepth = 5;

std::string Atom(RandomStream& random) { return fmt::format("p{}", random.Index(kAtoms)); }

std::string RandomLiteral(RandomStream& random) {
  return (random.Index(2) == 0 ? "" : "!") + Atom(random);
}

// Returns a random conjunction, like "p1" or "!p0 & p3".
std::string RandomConjunction(RandomStream& random) {
  if (random.Index(3) > 0) return Atom(random);
  const int first = random.Index(kAtoms);
  const int second = (first + 1 + random.Index(kAtoms - 1)) % kAtoms;
  const auto sign = [&] { return random.Index(2) == 0 ? "" : "!"; };
  const std::string one = fmt::format("{}p{}", sign(), first);
  return fmt::format("{} & {}p{}", one, sign(), second);
}

std::string RandomKnown(RandomStream& random) {
  return fmt::format("K({})", RandomLiteral(random));
}

// Returns a random query about what is known or unknown.
std::string RandomQuery(RandomStream& random) {
  switch (random.Index(8)) {
    case 0:
      return "!" + RandomKnown(random);
    case 1:
      return fmt::format("!Kw({})", RandomConjunction(random));
    case 2:
      return fmt::format("Kw({})", RandomConjunction(random));
    case 3:
      return fmt::format("!({} | {})", RandomKnown(random), RandomKnown(random));
    default:
      return RandomKnown(random);
  }
}

// Returns random effects. They set one half of the atoms and forget the other half, so that their
// order does not matter.
std::string RandomEffects(RandomStream& random) {
  std::string effects;
  const int groups = 1 + random.Index(3);
  for (int group = 0; group < groups; ++group) {
    const std::string sign = random.Index(2) == 0 ? "" : "!";
    const std::string set = fmt::format("add(Kf, {}p{})", sign, random.Index(kAtoms / 2));
    if (group > 0) effects += "; ";
    switch (random.Index(5)) {
      case 0:
        effects += set;
        break;
      case 1:
        effects += fmt::format("{} => {}", RandomQuery(random), set);
        break;
      case 2:
        effects += fmt::format("{} & {} => {}", RandomKnown(random), RandomQuery(random), set);
        break;
      case 3:
        effects += fmt::format("add(Kw, {})", RandomConjunction(random));
        break;
      case 4:
        effects += fmt::format("del(Kf, p{})", kAtoms / 2 + random.Index(kAtoms / 2));
        break;
    }
  }
  return effects;
}

std::string RandomDomain(RandomStream& random) {
  std::string text = "domain random predicates: p0, p1, p2, p3\n";
  const int actions = 2 + random.Index(4);
  for (int a = 0; a < actions; ++a) {
    std::string precondition = random.Index(3) == 0 ? RandomQuery(random) : "true";
    if (random.Index(3) == 0) precondition += " & " + RandomQuery(random);
    text += fmt::format("action a{} preconds: {} effects: {}\n", a, precondition,
                        RandomEffects(random));
  }
  if (random.Index(4) == 0) {
    text += fmt::format("updates: {} => add(Kf, {})\n", RandomQuery(random), RandomLiteral(random));
  }
  return text;
}

std::string RandomProblem(RandomStream& random) {
  std::string init;
  for (int atom = 0; atom < kAtoms; ++atom) {
    if (random.Index(3) == 0) {
      init += fmt::format("add(Kf, {}p{}), ", random.Index(2) == 0 ? "" : "!", atom);
    }
  }
  const int first = random.Index(kAtoms);
  const std::string alternatives =
      fmt::format("p{} | !p{} | p{}", first, (first + 1) % kAtoms, (first + 2) % kAtoms);
  init += random.Index(2) == 0 ? fmt::format("add(Kx, {})", alternatives)
                               : fmt::format("add(Kx, some({}))", alternatives);
  const char* const join = random.Index(4) == 0 ? "|" : "&";
  return fmt::format("problem random domain random init: {} goal: {} {} {}", init,
                     RandomQuery(random), join, RandomQuery(random));
}

class RandomDomains : public testing::TestWithParam<int> {
 protected:
  // Calls `test` with tasks of this quarter until it has returned true `count / kQuarters` times. A
  // contradictory init is drawn again.
  template <class Test>
  void ForTasks(int count, const Test& test) {
    int counted = 0;
    for (int seed = GetParam(); counted < count / kQuarters; seed += kQuarters) {
      RandomStream random(seed, "domains");
      const std::string domain = RandomDomain(random);
      const std::string problem = RandomProblem(random);
      SCOPED_TRACE(domain + problem);
      const GroundTask task = GroundText(domain, problem);
      const std::string message = MessageOf([&] { PlanFor(task, Wanted::kFirst); });
      if (message.find("contradicts") != std::string::npos) continue;
      counted += test(task) ? 1 : 0;
      if (HasFailure()) return;
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Quarters, RandomDomains, testing::Range(0, kQuarters));

void ExpectHolds(const GroundTask& task, const ContingentPlan& plan) {
  const TreeCheck check = CheckTree(task, plan.tree);
  EXPECT_TRUE(check.holds) << check.failure << "\n" << TextOf(task, plan.tree, Sharing::kOnce);
  EXPECT_TRUE(check.AreAllWorlds());
}

TEST_P(RandomDomains, TreesHoldInEveryWorld) {
  ForTasks(kTrees, [&](const GroundTask& task) {
    const ContingentPlan first = PlanFor(task, Wanted::kFirst);
    const ContingentPlan least = PlanFor(task, Wanted::kLeastDepth);
    EXPECT_EQ(first.outcome == Outcome::kBudget, !first.doubt.empty());
    EXPECT_EQ(first.outcome == Outcome::kFound, least.outcome == Outcome::kFound);
    if (first.outcome != Outcome::kFound) return false;
    ExpectHolds(task, first);
    ExpectHolds(task, least);
    return SizeOf(first.tree).nodes > 1;
  });
}

// Returns the tree with another action in place of one of its actions, or with swapped children of
// a branch.
PlanTree Corrupted(const GroundTask& task, PlanTree tree, RandomStream& random) {
  PlanNode& node = tree.nodes[random.Index(static_cast<int>(tree.nodes.size()))];
  if (node.kind == PlanNode::Kind::kAct) {
    node.action = ActionId(random.Index(static_cast<int>(task.actions.size())));
  }
  if (node.kind == PlanNode::Kind::kWhether) std::swap(node.children[0], node.children[1]);
  return tree;
}

// Oracle: all worlds one by one. Where sets of worlds give an answer, it is the same answer for the
// same number of worlds.
TEST_P(RandomDomains, SetsOfWorldsTellWhatWorldsTell) {
  RandomStream random(GetParam(), "corrupted trees");
  int told = 0;
  int refuted = 0;
  ForTasks(kTrees / 4, [&](const GroundTask& task) {
    const ContingentPlan plan = PlanFor(task, Wanted::kFirst);
    if (plan.outcome != Outcome::kFound || SizeOf(plan.tree).repeats > 0) return false;
    if (const auto check = CheckBySets(task, plan.tree)) {
      ++told;
      EXPECT_TRUE(check->holds) << check->failure;
      EXPECT_EQ(check->unreached, CheckTree(task, plan.tree).unreached);
      EXPECT_EQ(check->worlds,
                std::ssize(EnumerateWorlds(task, NumberMarks(task, plan.tree), 1000, 1).worlds));
    }
    for (int i = 0; i < 8; ++i) {
      const PlanTree tree = Corrupted(task, plan.tree, random);
      const auto check = CheckBySets(task, tree);
      if (!check) continue;
      const TreeCheck one_by_one = CheckTree(task, tree);
      EXPECT_EQ(check->holds, one_by_one.holds) << check->failure << "\n" << one_by_one.failure;
      refuted += check->holds ? 0 : 1;
    }
    return SizeOf(plan.tree).nodes > 1;
  });
  EXPECT_GT(told, kTrees / kQuarters / 8);
  EXPECT_GT(refuted, kTrees / kQuarters / 8);
}

TEST_P(RandomDomains, LeastDepthIsTheOracles) {
  ForTasks(kDomains, [&](const GroundTask& task) {
    if (!task.updates.empty()) return false;
    const ContingentPlan first = PlanFor(task, Wanted::kFirst);
    const ContingentPlan least = PlanFor(task, Wanted::kLeastDepth);
    const bool has_tree =
        least.outcome == Outcome::kFound && least.guarantee == Guarantee::kLeastDepth;
    const auto expected = oracle::WorldSetSearch(task).LeastDepth(kOraclesDepth);
    EXPECT_TRUE(has_tree || !expected) << "the oracle finds one of depth " << *expected;
    if (has_tree) {
      const int depth = SizeOf(least.tree).depth;
      EXPECT_TRUE(expected ? depth == *expected : depth > kOraclesDepth) << depth;
    }
    if (has_tree) {
      EXPECT_GE(SizeOf(first.tree).depth, SizeOf(least.tree).depth);
    }
    return true;
  });
}

}  // namespace
}  // namespace assay::contingent::random_domains_test
