#include "planner/contingent/pks_and_pddl/pddl_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "planner/contingent/pks_and_pddl/pddl_text.h"
#include "planner/contingent/pks_and_pddl/pks_text.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "tests/planner/contingent/mutation.h"
#include "tests/planner/contingent/tasks.h"

namespace assay::contingent::pddl_file_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

GroundTask GroundPddl(const std::string& domain_text, const std::string& problem_text) {
  const Domain domain = ReadPddlDomain(domain_text, "domain.pddl");
  Externs externs;
  return Ground(domain, ReadPddlProblem(problem_text, "problem.pddl", domain), externs);
}

// A coin is under one of three cups. Cups can be lifted, and a cup that is known to hide the coin
// can be taken.
constexpr const char* kCups = R"(
(define (domain cups)  ; a comment
  (:requirements :strips :typing)
  (:types cup)
  (:predicates (coin ?c - cup) (won) (lost))
  (:action LIFT :parameters (?c - cup) :precondition (not (lost)) :observe (coin ?c))
  (:action take
    :parameters (?c - cup)
    :precondition (and (not (won)) (not (lost)))
    :effect (and (when (coin ?c) (won)) (when (not (coin ?c)) (lost)))))
)";
constexpr const char* kThreeCups = R"(
(define (problem three) (:domain cups)
  (:objects a b c - cup)
  (:init (and (oneof (coin a) (coin b) (coin c))))
  (:hidden (coin b))
  (:goal (and (won) (not (lost)))))
)";

TEST(Pddl, ReadsAndPlans) {
  const GroundTask task = GroundPddl(kCups, kThreeCups);
  const ContingentPlan plan = PlanFor(task, Wanted::kLeastDepth);
  EXPECT_EQ(TextOf(task, plan.tree, Sharing::kUnfolded),
            "lift(a)\n"
            "branch coin(a)\n"
            "  take(a)\n"
            "branch !coin(a)\n"
            "  lift(b)\n"
            "  branch coin(b)\n"
            "    take(b)\n"
            "  branch !coin(b)\n"
            "    take(c)\n");
  const TreeCheck check = CheckTree(task, plan.tree);
  EXPECT_TRUE(check.holds) << check.failure;
  EXPECT_EQ(check.worlds, 3);
}

// Atoms that the init does not name are false. Atoms that it calls unknown are not false. Clauses
// are kept.
TEST(Pddl, ClosedWorld) {
  const std::string problem = R"((define (problem p) (:domain cups) (:objects a b c - cup)
    (:init (unknown (coin a)) (unknown (coin b)) (or (coin a) (not (coin b))))
    (:goal (won))))";
  const GroundTask task = GroundPddl(kCups, problem);
  const ContingentPlan plan = PlanFor(task, Wanted::kFirst);
  // The coin may be under no cup.
  EXPECT_EQ(plan.outcome, Outcome::kNone);
  ASSERT_EQ(task.initial.relations.size(), 1);
  EXPECT_TRUE(task.initial.relations.front().is_inclusive);
  EXPECT_THAT(task.atoms, testing::Not(testing::Contains("coin(c)")));  // this atom is always known
}

// The place in a corridor is unknown. After as many moves as the corridor has places, it is known.
TEST(Pddl, BeliefsAboutWhatChanges) {
  const char* const domain = R"((define (domain corridor)
    (:types place) (:predicates (at ?p - place))
    (:constants p1 p2 p3 p4 - place)
    (:action right :effect (and (when (at p1) (and (at p2) (not (at p1))))
                                (when (at p2) (and (at p3) (not (at p2))))
                                (when (at p3) (and (at p4) (not (at p3))))))))";
  const char* const problem = R"((define (problem p) (:domain corridor)
    (:init (oneof (at p1) (at p2) (at p3) (at p4))) (:goal (at p4))))";
  const GroundTask task = GroundPddl(domain, problem);
  const ContingentPlan plan = PlanFor(task, Wanted::kLeastDepth);
  EXPECT_EQ(TextOf(task, plan.tree, Sharing::kOnce), "right()\nright()\nright()\n");
  EXPECT_TRUE(CheckTree(task, plan.tree).holds);
}

TEST(Pddl, PrintsAsPks) {
  const Domain domain = ReadPddlDomain(kCups, "domain.pddl");
  const Problem problem = ReadPddlProblem(kThreeCups, "problem.pddl", domain);
  const GroundTask task = GroundText(TextOf(domain), TextOf(problem));
  EXPECT_EQ(SizeOf(PlanFor(task, Wanted::kLeastDepth).tree).depth, 3);
}

TEST(Pddl, AProblemOfAnotherDomainIsToldWithItsPlace) {
  const auto message = [](const std::string& name) {
    return MessageOf([&] {
      GroundPddl(kCups, "(define (problem p)\n (:domain " + name + ") (:init) (:goal (won)))");
    });
  };
  EXPECT_EQ(message("mugs"), "problem.pddl:2:11: a problem of 'mugs'; allowed: problems of 'cups'");
  EXPECT_THAT(message("(cups)"), StartsWith("problem.pddl:2:11: a list; allowed: a name"));
  EXPECT_EQ(message("CUPS"), "no error");
  EXPECT_EQ(message("cupz"), "no error");  // a wrong name, as in published problems
}

TEST(Pddl, ErrorsHaveTheirPlace) {
  const auto message = [](const std::string& domain, const std::string& problem) {
    return MessageOf([&] { GroundPddl(domain, problem); });
  };
  EXPECT_THAT(message("(define (domain d) (:predicates (p)) (:action a :effect (q)))",
                      "(define (problem p) (:domain d) (:init) (:goal (p)))"),
              StartsWith("domain.pddl:1:57: unknown predicate 'q'"));
  EXPECT_THAT(message("(define (domain d)", ""), StartsWith("domain.pddl:1:19: the file ends"));
  EXPECT_THAT(message("(define (domain d) (:axiom))", ""),
              StartsWith("domain.pddl:1:20: unknown section; allowed: :requirements"));
  EXPECT_THAT(message(kCups, "(define (problem p) (:domain cups) (:init (oneof)) (:goal (won)))"),
              StartsWith("problem.pddl:1:43: no alternatives"));
  EXPECT_THAT(message(std::string(100'000, '('), ""), HasSubstr("nested too deeply"));
  EXPECT_THAT(message(kCups, "(define (problem p) (:domain cups) (:init))"),
              StartsWith("problem.pddl:1:1: a problem without a goal; allowed: (:goal CONDITION)"));
  EXPECT_THAT(message(kCups, "(define (problem p) (:goal (won)) (:goal (lost)))"),
              StartsWith("problem.pddl:1:35: :goal a second time; allowed: one :goal"));
}

// One action of a domain and its error message.
TEST(Pddl, ErrorsInActions) {
  const auto message = [](const std::string& action) {
    return MessageOf([&] {
      GroundPddl("(define (domain d) (:types t) (:predicates (p) (q ?x - t))\n" + action + ")",
                 "(define (problem x) (:domain d) (:init) (:goal (p)))");
    });
  };
  EXPECT_EQ(message("(:action a :effect (p))"), "no error");
  EXPECT_EQ(
      message("(:action a :effect (forall (?x - t) (q ?x)))"),
      "domain.pddl:2:20: 'forall' is a part of PDDL that this reader does not support; allowed: "
      "literals, and, when");
  EXPECT_THAT(
      message("(:action a :effect (when (p) (or (p) (q ?x))))"),
      StartsWith("domain.pddl:2:30: 'or' is a part of PDDL that this reader does not support"));
  EXPECT_THAT(
      message("(:action a :precondition (exists (?x - t) (q ?x)) :effect (p))"),
      StartsWith("domain.pddl:2:26: 'exists' is a part of PDDL that this reader does not support; "
                 "allowed: literals, and, or and not"));
  EXPECT_THAT(message("(:action a :parameters (?x - t ?x - t) :effect (q ?x))"),
              StartsWith("domain.pddl:2:32: '?x' is declared twice"));
  EXPECT_THAT(message("(:action a :effect (p)) (:action a :effect (not (p)))"),
              StartsWith("domain.pddl:2:34: 'a' is declared twice"));
  EXPECT_THAT(message("(:action a :precondition (p) :precondition (not (p)) :effect (p))"),
              StartsWith("domain.pddl:2:30: :precondition a second time"));
}

constexpr std::array<const char*, 17> kPieces = {
    "(",         ")",           "(not ",  "(and ",   "(or ",
    "?c",        "- ",          "(when ", "(oneof ", "(unknown ",
    ":observe ", ":effect ",    ";",      "cup",     "(forall (?c - cup) ",
    "(= ?c a)",  ":parameters "};

constexpr int kQuarters = 4;  // quarters of the mutations run side by side

class PddlMutations : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Quarters, PddlMutations, testing::Range(0, kQuarters));

// A mistake in a file gives a task that can be planned for, or an InputError, and nothing else.
TEST_P(PddlMutations, AreSurvived) {
  RandomStream random(20261123, fmt::format("pddl mutations/{}", GetParam()));
  int loaded = 0;
  const int count = MutationCount() / kQuarters;
  for (int trial = 0; trial < count; ++trial) {
    std::string domain = kCups;
    std::string problem = kThreeCups;
    std::string& text = random.Index(2) == 0 ? domain : problem;
    for (int slips = 1 + random.Index(3); slips > 0 && !text.empty(); --slips) {
      text = Mutated(text, kPieces, random);
    }
    const std::string message = MessageOf([&] {
      const GroundTask task = GroundPddl(domain, problem);
      const ContingentPlan plan = PlanFor(task, Wanted::kFirst, 300);
      if (plan.outcome != Outcome::kFound) return;
      const TreeCheck check = CheckTree(task, plan.tree, {.worlds = 100});
      EXPECT_TRUE(check.holds) << check.failure;
    });
    loaded += message == "no error" ? 1 : 0;
    const bool tells = message == "no error" || message.starts_with("domain.pddl:") ||
                       message.starts_with("problem.pddl:");
    ASSERT_TRUE(tells && !HasFailure())
        << "trial " << trial << ": " << message << domain << problem;
  }
  EXPECT_GT(loaded, count / 50) << "mutations so coarse that they test the lexer alone";
  EXPECT_LT(loaded, count * 9 / 10);
}

// Exported tasks have plans of the same depth.
TEST(PddlText, ExportedTasksArePlannedTheSame) {
  for (const auto& [domain, problem] :
       {std::pair("force-sensing", "two-cans"), std::pair("visual-sensing", "one-bottle"),
        std::pair("bomb-in-the-toilet", "four-packages"), std::pair("medicate", "four-illnesses"),
        std::pair("unix", "find-a-file")}) {
    SCOPED_TRACE(problem);
    const GroundTask task = GroundScenario(domain, problem);
    const PddlFiles files = ToPddl(task, problem);
    const GroundTask read = GroundPddl(files.domain, files.problem);
    EXPECT_EQ(SizeOf(PlanFor(read, Wanted::kLeastDepth).tree).depth,
              SizeOf(PlanFor(task, Wanted::kLeastDepth).tree).depth);
  }
}

TEST(PddlText, WhatPddlDoesNotHaveIsNamed) {
  EXPECT_THAT(MessageOf([] { ToPddl(GroundScenario("pouring", "half-full-jug"), "p"); }),
              EndsWith("/pouring.pks:8:8: PDDL has no intervals; allowed: facts, functions of "
                       "objects, Kw of single atoms and Kx"));
  EXPECT_THAT(MessageOf([] { ToPddl(GroundScenario("opening-a-safe", "safe-with-note"), "p"); }),
              HasSubstr("PDDL has no"));
}

// A task is refused if it would mean something else in PDDL. Here a cup may be held or not after a
// try.
TEST(PddlText, WhatWouldMeanSomethingElseIsRefused) {
  EXPECT_THAT(MessageOf([] { ToPddl(GroundScenario("slippery-grasp", "hold-the-cup"), "p"); }),
              HasSubstr("slippery-grasp.pks:7:8: PDDL has no del(Kf, holding(cup)): PDDL cannot "
                        "tell false from unknown, and the problem depends on the difference"));
  const auto message = [](const std::string& action, const std::string& goal) {
    return MessageOf([&] {
      ToPddl(GroundText("domain d predicates: p, q\naction a effects: " + action,
                        "problem x domain d goal: " + goal),
             "p");
    });
  };
  EXPECT_EQ(message("add(Kf, p), del(Kf, q)", "K(p)"), "no error");
  EXPECT_THAT(message("add(Kf, p), del(Kf, q)", "K(p) & K(!q)"),
              StartsWith("domain.pks:2:8: PDDL has no del(Kf, q)"));
  EXPECT_THAT(message("K(q) => add(Kf, p), del(Kf, q)", "K(p)"),
              StartsWith("domain.pks:2:8: PDDL has no del(Kf, q)"));
  EXPECT_THAT(message("!K(q) => add(Kf, p)", "K(p)"),
              StartsWith("domain.pks:2:8: PDDL has no queries of what is not known"));
  EXPECT_THAT(message("add(Kf, q)", "!K(p)"),
              StartsWith("problem.pks:1:26: PDDL has no queries of what is not known"));
  EXPECT_THAT(message("add(Kw, q)", "Kw(q)"),
              StartsWith("problem.pks:1:26: PDDL has no Kw and Kv in queries"));
}

// Functions with an open value need exactly one value. Independent unknown atoms would allow worlds
// in which something is in two places.
TEST(PddlText, OpenFunctionsHaveExactlyOneValue) {
  const auto message = [](const std::string& init) {
    return MessageOf([&] {
      ToPddl(GroundText("domain d types: t constants: a, b, c: t predicates: p\n"
                        "functions: f: t action go effects: K(f = a) => add(Kf, p)",
                        "problem x domain d " + init + " goal: K(p)"),
             "p");
    });
  };
  EXPECT_EQ(message("init: add(Kx, f = b | f = a)"), "no error");
  EXPECT_EQ(message("init: add(Kf, f = b)"), "no error");
  EXPECT_EQ(message("init: add(Kf, f != b), add(Kf, f != c)"), "no error");
  for (const char* init : {"", "init: add(Kx, f = a | p)", "init: add(Kx, some(f = a | f = b))"}) {
    EXPECT_THAT(message(init),
                HasSubstr("PDDL has no functions with several values or none, like f"))
        << init;
  }
}

}  // namespace
}  // namespace assay::contingent::pddl_file_test
