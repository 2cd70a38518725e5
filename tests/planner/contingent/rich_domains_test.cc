#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "planner/base/random.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "tests/planner/contingent/tasks.h"

// Random domains with everything in the language: functions of objects and numbers, run-time
// variables, conjunctions in Kw, and update rules. There is no oracle for the depth of their trees,
// but each tree must hold.
namespace assay::contingent::rich_domains_test {
namespace {

constexpr int kQuarters = 4;  // quarters run side by side

// Returns the number of trees. The variable ASSAY_TREES sets another number, like 20000.
int TreeCount() {
  const char* count = std::getenv("ASSAY_TREES");
  return count == nullptr ? 1000 : std::atoi(count);
}

std::string Pick(RandomStream& random, const std::vector<const char*>& choices) {
  return choices[random.Index(static_cast<int>(choices.size()))];
}

std::string RandomKnown(RandomStream& random) {
  return Pick(random, {"K(p)", "K(!p)", "K(q)", "K(!q)", "K(r)", "K(!s)", "K(f = a)", "K(f != b)",
                       "K(n > 2)", "K(n <= 3)"});
}

std::string RandomNegation(RandomStream& random) {
  const std::string sensed =
      Pick(random, {"!Kw(p)", "!Kw(q & !r)", "!Kv(f)", "!Kv(n)", "!Kw(n > 2)"});
  return random.Index(2) == 0 ? sensed : "!" + RandomKnown(random);
}

std::string RandomQuery(RandomStream& random) {
  const std::string first = random.Index(3) == 0 ? RandomNegation(random) : RandomKnown(random);
  switch (random.Index(4)) {
    case 0:
      return first + " & " + RandomKnown(random);
    case 1:
      return first + " | " + RandomKnown(random);
    default:
      return first;
  }
}

std::string RandomFact(RandomStream& random) {
  return Pick(random, {"add(Kf, p)", "add(Kf, !p)", "add(Kf, q)", "add(Kf, !q)", "add(Kf, r)"});
}

// Returns a random condition on the world or on what is unknown. Most often it is empty.
std::string RandomCondition(RandomStream& random) {
  return Pick(random, {"", "", "", "K(q) => ", "K(!r) => ", "K(f = a) => ", "K(s) => ",
                       "K(p) | K(!q) => ", "K(q) & K(r) => ", "!Kw(r) => ", "!K(s) => ",
                       "K(n > 2) => ", "K(q & n <= 1) => ", "K(n > 1) | K(r) => "});
}

// Returns random knowledge that an action adds.
std::string RandomTold(RandomStream& random) {
  return Pick(random, {"add(Kx, p | q)", "add(Kx, q | !r | s)", "add(Kx, some(p | !q))",
                       "add(Kx, f = a | f = b)", "add(Kx, f = a | q)", "add(Kx, some(f = b | !p))",
                       "add(Kf, n <= 2)", "add(Kf, n > 1)"});
}

std::string RandomEffect(RandomStream& random) {
  switch (random.Index(11)) {
    case 0:
      return RandomFact(random);
    case 9:
      return RandomCondition(random) + RandomTold(random);
    case 10:
      return RandomCondition(random) + Pick(random, {"del(Kf, p)", "del(Kf, q)", "del(Kf, r)"});
    case 8:
      return RandomNegation(random) + " => " + RandomFact(random);
    case 1:
      return RandomCondition(random) + RandomFact(random);
    case 2:
      return RandomCondition(random) + Pick(random, {"add(Kw, p)", "add(Kw, q & !r)",
                                                     "add(Kw, q & r & !s)", "add(Kw, n > 2)"});
    case 3:
      return RandomCondition(random) +
             Pick(random, {"add(Kv, f)", "add(Kv, n within 0.2)", "add(Kv, n)"});
    case 4:
      return RandomCondition(random) +
             Pick(random, {"add(Kf, f = a)", "add(Kf, f = b)", "del(Kf, f = b)"});
    case 5:
      return RandomCondition(random) +
             Pick(random, {"add(Kf, n = n + 1)", "add(Kf, n = n + [0, 1])", "add(Kf, n = 2)"});
    case 6:
      return RandomCondition(random) + "del(Kf, s)";
    default:
      return RandomCondition(random) + "add(Kw, s)";
  }
}

std::string RandomEffects(RandomStream& random) {
  const std::string first = RandomEffect(random);
  return random.Index(2) == 0 ? first : first + "; " + RandomEffect(random);
}

std::string RandomDomain(RandomStream& random) {
  std::string text =
      "domain rich types: thing constants: a, b, c: thing\n"
      "predicates: p, q, r, s, t functions: f: thing, n: number\n"
      "action use(?x: thing) preconds: K(?x = f) effects: add(Kf, s)\n";
  const int actions = 3 + random.Index(4);
  for (int i = 0; i < actions; ++i) {
    text += fmt::format("action act{} preconds: {} effects: {}\n", i,
                        random.Index(3) == 0 ? RandomQuery(random) : "true", RandomEffects(random));
  }
  switch (random.Index(6)) {
    case 2:
      text += fmt::format("updates: {} => {}\n", RandomKnown(random), RandomTold(random));
      break;
    case 0:
      text += "updates: K(p) & K(s) => add(Kf, t); K(!p) => add(Kf, !t)\n";
      break;
    case 1:
      text += fmt::format("updates: {} => add(Kf, t)\n", RandomNegation(random));
      break;
    default:
      break;
  }
  return text;
}

std::string RandomProblem(RandomStream& random) {
  std::string init = Pick(random, {"add(Kf, n = [0, 3])", "add(Kf, n = 1)", "add(Kf, !s)"});
  for (const char* fact : {"add(Kf, p)", "add(Kf, !q)", "add(Kf, f = c)", "add(Kf, !t)",
                           "add(Kx, f = a | f = b)", "add(Kx, some(q | !r))", "add(Kw, r)",
                           "add(LCW, s)", "add(Kx, f = a | p)", "add(Kx, some(f = b | q))"}) {
    if (random.Index(3) == 0) init += std::string(", ") + fact;
  }
  return fmt::format("problem rich domain rich init: {} goal: {} & {}", init, RandomQuery(random),
                     Pick(random, {"K(s)", "K(t)", "Kw(q)", "Kw(p & r)", "Kv(f)", "K(n >= 3)",
                                   "Kv(n within 0.1)", "Kv(n)"}));
}

// Returns whether the checker gave up because it would need too many numbers. This is a limit of
// the checker, and no flaw of the tree.
bool IsOfTooManyNumbers(const TreeCheck& check) {
  return check.failure.find("a sample of numbers cannot tell") != std::string::npos;
}

class RichDomains : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Quarters, RichDomains, testing::Range(0, kQuarters));

TEST_P(RichDomains, TreesHoldInEveryWorld) {
  int planned = 0;
  for (int seed = GetParam(); planned < TreeCount() / kQuarters && !HasFailure();
       seed += kQuarters) {
    RandomStream random(seed, "rich domains");
    const std::string domain = RandomDomain(random);
    const std::string problem = RandomProblem(random);
    SCOPED_TRACE(domain + problem);
    const std::string message = MessageOf([&] {
      const GroundTask task = GroundText(domain, problem);
      for (const Wanted wanted : {Wanted::kFirst, Wanted::kLeastDepth}) {
        const ContingentPlan plan = PlanFor(task, wanted, 500);
        if (plan.outcome != Outcome::kFound || SizeOf(plan.tree).nodes == 1) continue;
        ++planned;
        const TreeCheck check = CheckTree(task, plan.tree);
        if (IsOfTooManyNumbers(check)) continue;
        EXPECT_TRUE(check.holds) << check.failure << "\n"
                                 << TextOf(task, plan.tree, Sharing::kOnce);
      }
    });
    EXPECT_THAT(message, testing::AnyOf("no error", testing::HasSubstr("contradicts"),
                                        testing::HasSubstr("two values at once")));
  }
}

}  // namespace
}  // namespace assay::contingent::rich_domains_test
