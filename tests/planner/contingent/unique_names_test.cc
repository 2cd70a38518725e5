#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/base/random.h"
#include "planner/contingent/knowledge/knowledge_base.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "planner/contingent/world_sets/initial_worlds.h"
#include "planner/contingent/world_sets/world_progression.h"
#include "tests/planner/contingent/tasks.h"

// A function has at most one value in everything that is known about it.
namespace assay::contingent::unique_names_test {
namespace {

using ::testing::HasSubstr;

constexpr int kTasks = 1500;

std::string Pick(RandomStream& random, const std::vector<const char*>& choices) {
  return choices[random.Index(static_cast<int>(choices.size()))];
}

std::string RandomRelation(RandomStream& random) {
  const auto literal = [&] {
    return Pick(random, {"f = a", "f = b", "f = c", "f != a", "g = a", "g != b", "p", "q", "!p"});
  };
  const std::string literals = literal() + " | " + literal();
  return random.Index(2) == 0 ? "add(Kx, " + literals + ")" : "add(Kx, some(" + literals + "))";
}

std::string RandomEffect(RandomStream& random) {
  return Pick(random, {"", "K(f = a) => ", "K(f != b) => ", "K(p) => ", "K(q & f = c) => ",
                       "K(f = a) | K(g = a) => "}) +
         Pick(random, {"add(Kf, f = a)", "add(Kf, f = c)", "add(Kf, f != b)", "del(Kf, f = a)",
                       "add(Kf, p)", "add(Kf, !q)", "del(Kf, q)", "add(Kf, g = b)"});
}

GroundTask RandomTask(RandomStream& random) {
  std::string domain =
      "domain u types: thing constants: a, b, c: thing predicates: p, q\n"
      "functions: f: thing, g: thing\n";
  for (int i = 0; i < 2; ++i) {
    domain += fmt::format("action act{}(?x: thing) effects: {}; {}\n", i, RandomEffect(random),
                          RandomEffect(random));
  }
  std::string init = RandomRelation(random);
  for (int i = random.Index(3); i > 0; --i) init += ", " + RandomRelation(random);
  return GroundText(
      domain, "problem u domain u init: " + init + " goal: K(p) & K(q) & K(f = a) & K(g = a)");
}

// Oracle: what is true in all worlds is known.
void ExpectKnown(const GroundTask& task, const KnowledgeBase& knowledge,
                 const KnowledgeState& state, const Worlds& worlds) {
  for (std::size_t a = 0; a < task.atoms.size(); ++a) {
    for (const bool value : {true, false}) {
      const GroundLiteral literal{AtomId(a), value};
      const bool is_known = std::ranges::all_of(
          worlds, [&](const World& world) { return WorldProgression::IsTrue(literal, world); });
      EXPECT_EQ(knowledge.layout().IsKnown(state, literal), is_known) << TextOf(task, literal);
    }
  }
}

TEST(UniqueNames, TellWhatWorldsTell) {
  int applied = 0;
  for (int seed = 0; seed < kTasks && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random(seed, "unique names");
    const std::string message = MessageOf([&] {
      const GroundTask task = RandomTask(random);
      const NumberMarks marks(task, {.nodes = {PlanNode{}}, .root = NodeId(0)});
      WorldProgression progression(task, marks, false, 100'000);
      History history;
      history.worlds = EnumerateWorlds(task, marks, 100'000, 1).worlds;
      KnowledgeBase knowledge(task);
      std::optional<KnowledgeState> state;
      const std::string contradiction = MessageOf([&] { state = knowledge.Initial(); });
      EXPECT_EQ(history.worlds.empty(), !state) << contradiction;
      for (int step = 0; state && !HasFailure(); ++step) {
        ExpectKnown(task, knowledge, *state, history.worlds);
        if (step == 3) break;
        const GroundAction& action =
            task.actions[random.Index(static_cast<int>(task.actions.size()))];
        state = knowledge.After(action, *state);
        progression.Apply(action.effects, history);
        EXPECT_EQ(!progression.TwoValued().IsNone(), !state);
        applied += state ? 1 : 0;
      }
    });
    EXPECT_THAT(message,
                testing::AnyOf("no error", HasSubstr("contradicts"), HasSubstr("two values")));
  }
  EXPECT_GT(applied, kTasks);
}

// Two rooms have motion detectors, and there is one guest.
TEST(UniqueNames, NoOneIsInTwoRooms) {
  const GroundTask task = GroundText(
      "domain house types: room constants: hall, kitchen, cellar: room\n"
      "predicates: light(room), alarm, asked, rung functions: where: room\n"
      "action sense effects: forall (?r: room) K(where = ?r) => add(Kf, light(?r));\n"
      "  add(Kf, asked)\n"
      "action ring preconds: K(asked)\n"
      "  effects: K(light(hall) & light(kitchen)) => add(Kf, alarm); add(Kf, rung)",
      "problem house domain house\n"
      "init: add(LCW, light(?r)), add(Kf, !alarm), add(Kf, !asked), add(Kf, !rung)\n"
      "goal: K(rung) & K(!alarm)");
  const ContingentPlan plan = PlanFor(task, Wanted::kLeastDepth);
  ASSERT_EQ(plan.outcome, Outcome::kFound);
  EXPECT_EQ(SizeOf(plan.tree).depth, 2);
  EXPECT_TRUE(CheckTree(task, plan.tree).holds);
}

// The cases are that both effects happen, that they may happen, and that they surely do not.
TEST(TwoValues, AreNotGivenAtOnce) {
  const auto task_with = [](const std::string& init) {
    return GroundText(
        "domain two types: thing constants: a, b, c: thing predicates: p, q, done\n"
        "functions: f: thing, n: number\n"
        "action touch effects: add(Kf, p), add(Kf, q)\n"
        "action go effects: K(p) => add(Kf, f = a); K(q) => add(Kf, f = b); add(Kf, done)\n"
        "action count effects: K(p) => add(Kf, n = 1); K(q) => add(Kf, n = 2); add(Kf, done)",
        "problem two domain two init: add(Kf, n = 0), " + init + " goal: K(done)");
  };
  for (const char* action : {"go", "count"}) {
    const auto check = [&](const GroundTask& task) {
      return CheckTree(task, {.nodes = {ActOf(task, action, 1), PlanNode{}}, .root = NodeId(0)});
    };
    for (const char* init : {"add(Kf, p), add(Kf, q)", "add(Kf, p)", "add(Kx, some(p | q))"}) {
      const GroundTask task = task_with(init);
      EXPECT_THAT(check(task).failure, HasSubstr("gets two values at once")) << init;
      EXPECT_EQ(PlanFor(task, Wanted::kFirst).outcome, Outcome::kNone) << init;
    }
    for (const char* init : {"add(Kf, !p)", "add(Kx, p | q)", "add(Kf, p), add(Kf, !q)"}) {
      const GroundTask task = task_with(init);
      EXPECT_TRUE(check(task).holds) << init;
      EXPECT_EQ(PlanFor(task, Wanted::kFirst).outcome, Outcome::kFound) << init;
    }
  }
}

// The sub-plan of the branch in which r is known is not reused in the branch in which r is unknown.
TEST(TwoValues, AreNotGivenByReusedSubPlans) {
  const GroundTask task = GroundText(
      "domain two types: thing constants: a, b, c: thing predicates: r, s, mixed\n"
      "functions: f: thing\n"
      "action mix preconds: K(!mixed)\n"
      "  effects: add(Kf, mixed); K(!s) => del(Kf, r); add(Kw, s)\n"
      "action go preconds: K(mixed) effects: K(!r) => add(Kf, f = b); add(Kf, f = a)\n"
      "action mend preconds: K(mixed) & K(!s) effects: add(Kf, r)",
      "problem two domain two init: add(Kf, f = c), add(Kf, r), add(Kf, !mixed) goal: K(f = a)");
  for (const Wanted wanted : {Wanted::kFirst, Wanted::kLeastDepth}) {
    const ContingentPlan plan = PlanFor(task, wanted);
    ASSERT_EQ(plan.outcome, Outcome::kFound);
    EXPECT_EQ(SizeOf(plan.tree).depth, 3);
    EXPECT_EQ(CheckTree(task, plan.tree).failure, "");
  }
}

TEST(TwoValues, AreAnErrorWhereTheyAreEvident) {
  const auto message = [](const std::string& effects) {
    return MessageOf([&] {
      GroundText(
          "domain two types: thing constants: a, b: thing functions: f: thing, n: number\n"
          "action go effects: " +
              effects,
          "problem two domain two goal: K(f = a)");
    });
  };
  EXPECT_THAT(message("add(Kf, f = a); add(Kf, f = b)"),
              HasSubstr("domain.pks:2:36: f gets two values at once"));
  EXPECT_THAT(message("add(Kf, n = 1), add(Kf, n = 2)"),
              HasSubstr("domain.pks:2:20: n gets two values at once"));
  EXPECT_EQ(message("add(Kf, f = a); add(Kf, f = a)"), "no error");
  // An action with one parameter has the error in its instances. An action with two parameters
  // would have the error only in the instances in which ?x and ?y differ.
  const auto message_of_parameters = [](const std::string& parameters, const std::string& effects) {
    return MessageOf([&] {
      GroundText(
          "domain two types: thing constants: a, b: thing functions: g(thing): thing\n"
          "action go(" +
              parameters + ") effects: " + effects,
          "problem two domain two goal: K(g(a) = a)");
    });
  };
  EXPECT_THAT(message_of_parameters("?x: thing", "add(Kf, g(?x) = a), add(Kf, g(?x) = b)"),
              HasSubstr("domain.pks:2:31: g(a) gets two values at once"));
  EXPECT_EQ(message_of_parameters("?x: thing, ?y: thing", "add(Kf, g(a) = ?x), add(Kf, g(a) = ?y)"),
            "no error");
  EXPECT_EQ(message("add(Kf, f = a); K(n > 2) => add(Kf, f = b)"), "no error");
}

}  // namespace
}  // namespace assay::contingent::unique_names_test
