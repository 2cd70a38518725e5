#include "planner/contingent/pks_and_pddl/pks_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "planner/base/random.h"
#include "planner/contingent/pks_and_pddl/pks_text.h"
#include "planner/contingent/plan_tree/tree_text.h"
#include "planner/contingent/tree_check/tree_check.h"
#include "tests/planner/contingent/mutation.h"
#include "tests/planner/contingent/tasks.h"

namespace assay::contingent::pks_file_test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Files {
  std::string domain;
  std::string problem;
};

// Returns all scenarios. A problem names its domain, and the file of the domain has that name.
std::vector<Files> AllScenarios() {
  std::vector<Files> all;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry :
       std::filesystem::directory_iterator(ASSAY_SOURCE_DIR "/scenarios/know")) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const std::filesystem::path& path : paths) {
    if (path.extension() != ".pks") continue;
    const std::string text = TextOfFile(path);
    if (text.find("\nproblem ") == std::string::npos && !text.starts_with("problem ")) continue;
    const Problem problem = ReadPksProblem(text, path.string());
    all.push_back({TextOfFile(path.parent_path() / (problem.domain + ".pks")), text});
  }
  return all;
}

constexpr const char* kDomain =
    "domain test\n"
    "types: thing; cup, plate: thing; place\n"
    "predicates: clean(thing), idle\n"
    "functions: at(thing): place, weight(thing): number\n"
    "externs: near(place, place)\n"
    "constants: sink: place\n"
    "action wash(?t: thing)\n"
    "  preconds: K(at(?t) = sink)\n"
    "  effects: add(Kf, clean(?t))\n";
constexpr const char* kProblem =
    "problem test\n"
    "domain test\n"
    "objects: c: cup\n"
    "init: add(Kf, at(c) = sink)\n"
    "goal: K(clean(c))\n";

std::string MessageOf(const std::string& domain, const std::string& problem) {
  return contingent::MessageOf([&] { GroundText(domain, problem); });
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(PksFile, TheExampleIsRight) { EXPECT_EQ(MessageOf(kDomain, kProblem), "no error"); }

// An error in a domain: the text that is replaced, its replacement, and the message.
struct Slip {
  const char* from;
  const char* to;
  const char* message;
};

class Slips : public testing::TestWithParam<Slip> {};

INSTANTIATE_TEST_SUITE_P(
    InDomain, Slips,
    testing::Values(
        Slip{"add(Kf, clean(?t))", "", "domain.pks:10:1: the file ends here"},
        Slip{"K(at(?t) = sink)", "", "domain.pks:9:3: unexpected 'effects'"},
        Slip{"add(Kf, clean(?t))", "add(Kf, claen(?t))",
             "domain.pks:9:20: unknown predicate 'claen', did you mean 'clean'?; allowed: clean, "
             "idle"},
        Slip{"clean(?t)", "clean(?x)",
             "domain.pks:9:26: unknown variable '?x', did you mean '?t'?; allowed: ?t"},
        Slip{"clean(?t)", "clean(sink)",
             "domain.pks:9:26: this is of type 'place'; allowed: 'thing', as 'clean' is declared"},
        Slip{"clean(?t)", "clean(?t, ?t)",
             "domain.pks:9:20: 'clean' has 2 arguments here; allowed: 1, as declared"},
        Slip{"add(Kf, ", "add(Kq, ",
             "domain.pks:9:16: unknown store 'Kq'; allowed: Kf, Kw, Kv, Kx or LCW"},
        Slip{"?t: thing", "?t: thnig", "domain.pks:7:13: unknown type 'thnig', did you mean "},
        Slip{"at(?t) = sink", "at(?t) > sink", "domain.pks:8:15: objects have no order"},
        Slip{"at(?t) = sink", "at(?t) = 3", "domain.pks:8:15: a number is compared with an object"},
        Slip{"at(?t) = sink", "weight(?t) > weight(?t)", "domain.pks:8:28: not a bound"},
        Slip{"at(?t) = sink", "clean(at(?t))", "domain.pks:8:21: a nested term"},
        Slip{"K(at(?t) = sink)", "extern(near(sink, sink))",
             "domain.pks:8:13: unexpected 'extern'; allowed: K(...), Kw(...)"},
        Slip{"K(at(?t) = sink)", "K(extern(near(sink, sink)))",
             "domain.pks:8:15: extern 'near' has no procedure"},
        Slip{"K(at(?t) = sink)", "Kv(clean)", "domain.pks:8:16: unknown constant 'clean'"},
        Slip{"K(at(?t) = sink)", "K(at(?t) = sink) &",
             "domain.pks:9:3: unexpected 'effects'; allowed: K(...), Kw(...)"},
        Slip{"types: thing;", "types: thing; thing;", "domain.pks:2:15: 'thing' is declared twice"},
        Slip{"types: thing;", "types: thing: cup;", "domain.pks:2:8: type 'thing' is its own"},
        Slip{"idle", "idle, at(thing)", "domain.pks:4:12: 'at' is declared twice"},
        Slip{"domain test", "domian test", "domain.pks:1:1: unexpected 'domian'; allowed: 'domain"},
        Slip{"externs:", "exterms:", "domain.pks:5:1: unknown section 'exterms'; allowed: types:"},
        Slip{"sink)", "sink) %", "domain.pks:8:30: unknown character '%'"},
        Slip{"at(?t) = sink", "weight(?t) > 1e999", "domain.pks:8:28: '1e999' is no number"},
        Slip{"K(at(?t) = sink)", "Kv(at(?t) within 1)",
             "domain.pks:8:16: 'within' needs a numeric function"},
        Slip{"K(at(?t) = sink)", "Kv(weight(?t) within -1)",
             "domain.pks:8:34: an error of -1; allowed: 0 or more"},
        Slip{"add(Kf, clean(?t))", "add(Kf, weight(?t) = [3, 2])",
             "domain.pks:9:34: the interval [3, 2] is empty"},
        Slip{"action wash(?t: thing)", "action wash(?t: thing, ?t: thing)",
             "domain.pks:7:24: '?t' is declared twice; allowed: a name of its own for each"},
        Slip{"action wash(?t: thing)", "action wash() action wash(?t: thing)",
             "domain.pks:7:22: 'wash' is declared twice; allowed: a name of its own for each"},
        Slip{"  effects:", "  preconds: true\n  effects:",
             "domain.pks:9:3: 'preconds:' a second time; allowed: one preconds:"},
        Slip{"  preconds:", "  effects: add(Kf, idle)\n  preconds:",
             "domain.pks:10:3: 'effects:' a second time; allowed: one effects:"}));

// at(?t) is a place and ?t is a thing, so that they are never equal.
INSTANTIATE_TEST_SUITE_P(
    OfTypes, Slips,
    testing::Values(
        Slip{"at(?t) = sink", "at(?t) = ?t",
             "domain.pks:8:24: '?t' is of type 'thing'; allowed: 'place', as 'at' is declared"},
        Slip{"at(?t) = sink", "at(?t) != ?t", "domain.pks:8:25: '?t' is of type 'thing'; allowed"},
        Slip{"at(?t) = sink", "?t = at(?t)", "domain.pks:8:15: '?t' is of type 'thing'; allowed"},
        Slip{"at(?t) = sink", "?t = sink",
             "domain.pks:8:20: 'sink' is of type 'place'; allowed: 'thing', as the other side"},
        Slip{"K(at(?t) = sink)", "Kw(at(?t) = ?t)", "domain.pks:8:25: '?t' is of type 'thing'"},
        Slip{"add(Kf, clean(?t))", "add(Kf, at(?t) = ?t)",
             "domain.pks:9:29: '?t' is of type 'thing'; allowed: 'place', as 'at' is declared"},
        Slip{"add(Kf, clean(?t))", "add(Kw, at(?t) = ?t)",
             "domain.pks:9:29: '?t' is of type 'thing'"},
        Slip{"add(Kf, clean(?t))", "add(Kx, at(?t) = sink | at(?t) = ?t)",
             "domain.pks:9:45: '?t' is of type 'thing'"},
        Slip{"add(Kf, clean(?t))", "add(Kf, sink = sink)",
             "domain.pks:9:20: no function; allowed: f(...) = constant"},
        Slip{"at(?t) = sink", "at(?t) = at(?t)",
             "domain.pks:8:24: 'at' is a function, as is the other side; allowed: a constant or a "
             "?variable on one side"}));

TEST_P(Slips, AreToldWithTheirPlace) {
  EXPECT_THAT(MessageOf(Replaced(kDomain, GetParam().from, GetParam().to), kProblem),
              StartsWith(GetParam().message));
}

TEST(PksFile, SlipsInProblems) {
  EXPECT_THAT(MessageOf(kDomain, Replaced(kProblem, "c: cup", "c: cupp")),
              StartsWith("problem.pks:3:10: unknown type 'cupp', did you mean 'cup'?"));
  EXPECT_THAT(MessageOf(kDomain, Replaced(kProblem, "goal: K(clean(c))\n", "")),
              StartsWith("problem.pks:5:1: the file ends here; allowed: a goal"));
  EXPECT_THAT(MessageOf(kDomain, Replaced(kProblem, "clean(c)", "clean(d)")),
              StartsWith("problem.pks:5:15: unknown constant 'd'"));
  EXPECT_THAT(MessageOf(kDomain, Replaced(kProblem, "at(c) = sink", "at(c) = c")),
              StartsWith("problem.pks:4:23: 'c' is of type 'cup'; allowed: 'place', as 'at'"));
  EXPECT_THAT(MessageOf(kDomain, Replaced(kProblem, "goal:", "goal: true\ngoal:")),
              StartsWith("problem.pks:6:1: 'goal:' a second time; allowed: one goal:"));
}

TEST(PksFile, WhereNothingIsDeclaredNothingIsAllowed) {
  EXPECT_EQ(MessageOf("domain d predicates: p(box)", "problem p domain d goal: true"),
            "domain.pks:1:24: unknown type 'box'; allowed: nothing");
  EXPECT_EQ(MessageOf("domain d", "problem p domain d externs: near(a) goal: true"),
            "problem.pks:1:29: unknown extern 'near'; allowed: nothing");
}

TEST(PksFile, AProblemOfAnotherDomainIsToldWithItsPlace) {
  const std::string folder = ASSAY_SOURCE_DIR "/scenarios/know/";
  EXPECT_THAT(
      contingent::MessageOf([&] { LoadTask(folder + "unix.pks", folder + "one-bottle.pks"); }),
      EndsWith("one-bottle.pks:4:8: a problem of 'visual-sensing'; allowed: problems of "
               "'unix'"));
}

// ---- Contradictions

// An init and the error message for its contradiction; an empty message if there is none.
struct Init {
  const char* init;
  const char* message;
};

class Contradictions : public testing::TestWithParam<Init> {};

INSTANTIATE_TEST_SUITE_P(
    InInit, Contradictions,
    testing::Values(
        Init{"add(Kf, idle), add(Kf, idle)", ""},
        Init{"add(Kf, idle), add(Kf, !idle)",
             "4:22: this contradicts what is known: idle is known to be true and false; allowed: "
             "what can hold together with the rest of init"},
        Init{"add(Kf, at(c) = sink), add(Kf, at(c) = shelf)",
             "4:30: this contradicts what is known: at(c) = sink is known to be true and false"},
        Init{"add(Kf, at(c) = sink), add(Kf, at(c) != sink)", "4:30: this contradicts"},
        Init{"add(Kf, at(c) != sink), add(Kf, at(c) = sink)", "4:31: this contradicts"},
        Init{"add(Kf, at(c) = sink), add(Kf, at(c) != shelf)", ""},
        Init{"add(Kf, at(c) != sink), add(Kf, at(c) != shelf)",
             "4:31: this contradicts what is known: no value is left for at(c)"},
        Init{"add(Kx, at(c) = sink | at(c) = shelf), add(Kf, at(c) = shelf)", ""},
        Init{"add(Kf, weight(c) > 3), add(Kf, weight(c) < 2)",
             "4:31: this contradicts what is known: no number is left for weight(c)"},
        Init{"add(Kf, weight(c) > 3), add(Kf, weight(c) <= 3)", "4:31: this contradicts"},
        Init{"add(Kf, weight(c) >= 3), add(Kf, weight(c) <= 3)", ""},
        Init{"add(Kf, weight(c) = [2, 3]), add(Kf, weight(c) > 4)", "4:36: this contradicts"},
        Init{"add(Kf, weight(c) > 4), add(Kf, weight(c) = [2, 3])", "4:31: this contradicts"},
        Init{"add(Kf, weight(c) = [2, 3]), add(Kf, weight(c) = [4, 5])", "4:36: this contradicts"},
        Init{"add(Kf, weight(c) = [2, 3]), add(Kf, weight(c) = [3, 5])", ""}));

TEST_P(Contradictions, AreToldWithTheirPlace) {
  const std::string domain = Replaced(kDomain, "sink: place", "sink, shelf: place");
  const std::string problem = fmt::format(
      "problem test\ndomain test\nobjects: c: cup\ninit: {}\ngoal: true\n", GetParam().init);
  const std::string message = MessageOf(domain, problem);
  if (*GetParam().message == '\0') {
    EXPECT_EQ(message, "no error");
  } else {
    EXPECT_THAT(message, StartsWith(fmt::format("problem.pks:{}", GetParam().message)));
  }
}

// If the init states two intervals of a number, the number is in both.
TEST(Init, IntervalsAreMet) {
  const std::string problem =
      "problem test domain test objects: c: cup\n"
      "init: add(Kf, weight(c) < 5), add(Kf, weight(c) = [2, 4]), add(Kf, weight(c) < 7)\n"
      "goal: K(weight(c) <= 4) & K(weight(c) >= 2)";
  const GroundTask task = GroundText(kDomain, problem);
  ASSERT_EQ(task.initial.ranges.size(), 1);
  EXPECT_EQ(task.initial.ranges.front(), (Range{.low = 2, .high = 4}));
}

// ---- Limits

// The action would have 20^8 = 25,600,000,000 instances. The error comes before any instance is
// made.
TEST(Grounding, TooManyInstancesAreCounted) {
  std::string domain =
      "domain d\ntypes: t\npredicates: g, r(t, t)\n"
      "action a(?a, ?b, ?c, ?d, ?e, ?f, ?h, ?i: t)\n"
      "  preconds: K(r(?a, ?b)) & K(r(?h, ?i))\n  effects: add(Kf, g)";
  std::string problem = "problem p domain d objects: o0";
  for (int i = 1; i < 20; ++i) problem += fmt::format(", o{}", i);
  problem += ": t init: {} goal: K(g)";
  EXPECT_EQ(MessageOf(domain, Replaced(problem, "{}", "")),
            "domain.pks:4:8: action 'a' has 25600000000 instances; too many remain after the "
            "initial knowledge rules some out; allowed: 100000 ground actions in all");
  // Instances that are ruled out do not count. Here four of the parameters have one value left
  // each.
  domain = Replaced(domain, "K(r(?h, ?i))", "K(r(?c, ?d)) & K(r(?e, ?f)) & K(r(?h, ?i))");
  EXPECT_EQ(MessageOf(domain, Replaced(problem, "{}", "add(LCW, r(?x, ?y)), add(Kf, r(o1, o2))")),
            "no error");
}

// The effect and the query would have 10^7 instances. The error comes before any instance is made.
TEST(Grounding, TooManyInstancesOfVariablesAreCounted) {
  const std::string problem = "problem p domain d objects: a, b, c, d, e, f, g, h, i, j: t goal: ";
  const std::string domain = "domain d types: t predicates: p(t)\naction a effects:\n";
  EXPECT_EQ(
      MessageOf(domain + "forall (?a, ?b, ?c, ?d, ?e, ?f, ?g: t) add(Kf, p(?a))", problem + "true"),
      "domain.pks:3:9: 10000000 instances, with those before 10000000; allowed: 1000000 of "
      "all effects and queries with variables");
  EXPECT_THAT(MessageOf(domain + "forall (?a: t) add(Kf, p(?a))",
                        problem + "\nexistsK(?a, ?b, ?c, ?d, ?e, ?f, ?g: t) K(p(?a))"),
              StartsWith("problem.pks:2:9: 10000000 instances, with those before 10000010"));
}

// ---- Update rules

// Rules that undo each other reach no final state, which is an error. If one of them stops the
// other, there is no error.
TEST(Updates, ThatDoNotComeToRestAreTold) {
  const auto message = [](const std::string& updates, const std::string& init) {
    return contingent::MessageOf([&] {
      const GroundTask task = GroundText(
          "domain d predicates: p, q functions: n: number action a effects: add(Kf, q)\n"
          "updates: " +
              updates,
          "problem x domain d init: " + init + " goal: K(q)");
      PlanFor(task, Wanted::kFirst);
    });
  };
  EXPECT_THAT(message("K(p) => add(Kf, !p);\nK(!p) => add(Kf, p)", "add(Kf, p)"),
              StartsWith("domain.pks:2:10: the update rules still change knowledge after"));
  EXPECT_THAT(message("K(p) => add(Kf, !p);\nK(!p) => add(Kf, p)", "add(Kf, !p)"),
              HasSubstr("allowed: rules that do not undo what others do"));
  EXPECT_THAT(message("K(q) & K(p) => add(Kf, !p);\nK(q) & K(!p) => add(Kf, p)", "add(Kf, p)"),
              StartsWith("domain.pks:2:10: the update rules still change knowledge after"));
  EXPECT_THAT(message("true => add(Kf, n = n + 1)", "add(Kf, n = 0)"),
              StartsWith("domain.pks:2:10: the update rules still change knowledge after"));
  EXPECT_EQ(message("K(p) => add(Kf, !p); K(p) => add(Kf, q)", "add(Kf, p)"), "no error");
  EXPECT_EQ(message("K(n < 9) => add(Kf, n = n + 1)", "add(Kf, n = 0)"), "no error");
}

// Wherever a file is cut, the error is reported at the end of the rest.
TEST(PksFile, CutInTheMiddle) {
  const std::string domain = kDomain;
  int errors = 0;
  for (std::size_t length = 0; length < domain.size(); ++length) {
    const std::string message = MessageOf(domain.substr(0, length), kProblem);
    if (message == "no error") continue;
    EXPECT_THAT(message, testing::AnyOf(StartsWith("domain.pks:"), StartsWith("problem.pks:")));
    ++errors;
  }
  EXPECT_GT(errors, static_cast<int>(domain.size()) * 3 / 4);
}

TEST(PksFile, DeepNestingIsRefused) {
  for (const char* piece : {"(", "!", "K(", "K(!"}) {
    std::string deep = piece;
    for (int i = 0; i < 100'000; ++i) deep += piece[std::string_view(piece).size() - 1];
    EXPECT_THAT(MessageOf(Replaced(kDomain, "K(at(?t) = sink)", deep), kProblem),
                HasSubstr("nested too deeply; allowed: 100 levels"));
  }
}

TEST(PksFile, AnExternThatThrowsIsTheCallsError) {
  const std::string domain = Replaced(kDomain, "K(at(?t) = sink)", "K(extern(near(sink, sink)))");
  Externs externs;
  externs.Add("near", [](std::span<const std::string>) -> bool {
    throw std::runtime_error("the arm is not there");
  });
  EXPECT_EQ(contingent::MessageOf([&] { GroundText(domain, kProblem, externs); }),
            "domain.pks:8:15: near(sink, sink) failed: the arm is not there");
}

TEST(PksFile, ExternsAreAskedOnce) {
  const std::string domain =
      Replaced(kDomain, "K(at(?t) = sink)", "K(extern(near(sink, sink))) & K(at(?t) = sink)");
  int calls = 0;
  Externs externs;
  externs.Add("near", [&](std::span<const std::string> arguments) {
    ++calls;
    return arguments[0] == arguments[1];
  });
  const GroundTask task =
      GroundText(domain, Replaced(kProblem, "c: cup", "c, d, e, f: cup"), externs);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(task.actions.size(), 4);
}

// A printed task reads back as the same task: it prints the same and has the same plan.
TEST(PksText, ReadsBack) {
  for (const Files& files : AllScenarios()) {
    const Domain domain = ReadPksDomain(files.domain, "domain.pks");
    const Problem problem = ReadPksProblem(files.problem, "problem.pks");
    SCOPED_TRACE(problem.name);
    const Files printed{TextOf(domain), TextOf(problem)};
    EXPECT_EQ(TextOf(ReadPksDomain(printed.domain, "printed.pks")), printed.domain);
    EXPECT_EQ(TextOf(ReadPksProblem(printed.problem, "printed.pks")), printed.problem);
    const GroundTask task = GroundText(files.domain, files.problem);
    const GroundTask again = GroundText(printed.domain, printed.problem);
    EXPECT_EQ(TextOf(task, PlanFor(task, Wanted::kFirst).tree, Sharing::kOnce),
              TextOf(again, PlanFor(again, Wanted::kFirst).tree, Sharing::kOnce));
  }
}

// ---- Mutations

constexpr std::array<const char*, 24> kPieces = {
    "(",  ")",        ",",          ":",        ";",      "&",      "|", "!",
    "=>", "?o",       "?x: object", "K(",       "#",      "[",      "=", ">",
    "42", "add(Kf, ", "Kv(",        "forallK(", "object", "number", "-", "\n"};

constexpr int kQuarters = 4;  // quarters of the mutations run side by side

class Mutations : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Quarters, Mutations, testing::Range(0, kQuarters));

// A mistake in a file gives a task that can be planned for, or an InputError, and nothing else.
TEST_P(Mutations, AreSurvived) {
  const std::vector<Files> scenarios = AllScenarios();
  RandomStream random(20240601, fmt::format("pks mutations/{}", GetParam()));
  int loaded = 0;
  const int count = MutationCount() / kQuarters;
  for (int trial = 0; trial < count; ++trial) {
    Files files = scenarios[trial % scenarios.size()];
    std::string& text = random.Index(2) == 0 ? files.domain : files.problem;
    for (int slips = 1 + random.Index(3); slips > 0 && !text.empty(); --slips) {
      text = Mutated(text, kPieces, random);
    }
    const std::string message = contingent::MessageOf([&] {
      const GroundTask task = GroundText(files.domain, files.problem);
      const ContingentPlan plan = PlanFor(task, Wanted::kFirst, 300);
      if (plan.outcome != Outcome::kFound) return;
      const TreeCheck check = CheckTree(task, plan.tree, {.worlds = 100});
      EXPECT_TRUE(check.holds) << check.failure;
    });
    loaded += message == "no error" ? 1 : 0;
    const bool tells = message == "no error" || message.starts_with("domain.pks:") ||
                       message.starts_with("problem.pks:");
    ASSERT_TRUE(tells && !HasFailure()) << "trial " << trial << ": " << message << "\n"
                                        << files.domain << files.problem;
  }
  EXPECT_GT(loaded, count / 50) << "mutations so coarse that they test the lexer alone";
  EXPECT_LT(loaded, count * 9 / 10);
}

}  // namespace
}  // namespace assay::contingent::pks_file_test
