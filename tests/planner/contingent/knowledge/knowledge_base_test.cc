#include "planner/contingent/knowledge/knowledge_base.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "planner/contingent/grounding/ground_query.h"
#include "tests/planner/contingent/tasks.h"

// Tests of the semantics of PKS (Petrick and Bacchus 2002, 2004), statement by statement.
namespace assay::contingent::knowledge_base_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr const char* kDomain =
    "domain test types: thing\n"
    "predicates: p(thing), q(thing), r\n"
    "functions: at(thing): thing, weight(thing): number\n";

// A knowledge state in which actions can be done by name and questions can be asked.
class Mind {
 public:
  explicit Mind(const std::string& init, const std::string& actions = "",
                const std::vector<std::string>& questions = {})
      : questions_(questions) {
    std::string all = kDomain + actions;
    // Each question is the precondition of its own action.
    for (std::size_t i = 0; i < questions.size(); ++i) {
      all += fmt::format("\naction ask{} preconds: {} effects: add(Kf, r)", i, questions[i]);
    }
    // This action keeps questions from being answered when the problem is grounded.
    all +=
        "\naction touch(?x: thing, ?y: thing) effects: add(Kf, p(?x)), add(Kf, q(?x)), "
        "add(Kf, at(?x) = ?y), add(Kf, !r)";
    const std::string problem =
        "problem test domain test objects: a, b, c: thing init: " + init + " goal: K(r)";
    task_ = std::make_unique<GroundTask>(GroundText(all, problem));
    knowledge_ = std::make_unique<KnowledgeBase>(*task_);
    state_ = knowledge_->Initial();
  }

  // Returns the query of a question; false if it was answered when the problem was grounded.
  GroundQuery Asks(const std::string& question) const {
    const auto found = std::find(questions_.begin(), questions_.end(), question);
    EXPECT_NE(found, questions_.end()) << question;
    const std::string name = fmt::format("ask{}", found - questions_.begin());
    for (const GroundAction& action : task_->actions) {
      if (action.name == name) return action.precondition;
    }
    return ConstantQuery(false);
  }
  bool Holds(const std::string& question) const {
    return knowledge_->Holds(Asks(question), state_);
  }

  void Do(const std::string& name) {
    for (const GroundAction& action : task_->actions) {
      if (action.name != name) continue;
      ASSERT_TRUE(knowledge_->Holds(action.precondition, state_)) << name;
      state_ = *knowledge_->After(action, state_);
      return;
    }
    FAIL() << name;
  }

  void Learn(const std::string& atom, bool value) {
    for (std::size_t a = 0; a < task_->atoms.size(); ++a) {
      if (task_->atoms[a] == atom) state_ = *knowledge_->Learned(state_, {AtomId(a), value});
    }
  }

  // Learns the truth of the only formula.
  void LearnSensed(bool value) { state_ = *knowledge_->Learned(state_, FormulaId(0), value); }

  // Takes a branch of the first formula that branches, and returns its text.
  std::string Branch(bool value) {
    const FormulaId formula = knowledge_->FormulaToBranch(state_);
    if (formula.IsNone()) return "";
    state_ = *knowledge_->Learned(state_, formula, value);
    return TextOf(*task_, task_->formulas[formula.index()]);
  }

  // Returns the values of the first function that branches.
  std::vector<std::string> ValuesToBranch() {
    std::vector<std::string> values;
    const auto functions = knowledge_->FunctionsToBranch(state_);
    if (functions.empty()) return values;
    for (const AtomId value : knowledge_->PossibleValues(functions.front(), state_)) {
      values.push_back(task_->atoms[value.index()]);
    }
    return values;
  }

  const KnowledgeState& state() const { return state_; }

 private:
  std::vector<std::string> questions_;
  std::unique_ptr<GroundTask> task_;
  std::unique_ptr<KnowledgeBase> knowledge_;
  KnowledgeState state_;
};

const std::vector<std::string> kAboutA = {"K(p(a))",  "K(!p(a))",  "Kw(p(a))",
                                          "!K(p(a))", "!K(!p(a))", "!Kw(p(a))"};

TEST(Queries, NothingIsKnownOfWhatIsNotSaid) {
  const Mind mind("add(Kf, p(b))", "", kAboutA);
  EXPECT_FALSE(mind.Holds("K(p(a))"));
  EXPECT_FALSE(mind.Holds("K(!p(a))"));
  EXPECT_FALSE(mind.Holds("Kw(p(a))"));
  EXPECT_TRUE(mind.Holds("!K(p(a))"));
  EXPECT_TRUE(mind.Holds("!K(!p(a))"));
  EXPECT_TRUE(mind.Holds("!Kw(p(a))"));
}

TEST(Queries, KnownTrueAndKnownFalseAreKnownWhether) {
  for (const bool value : {true, false}) {
    const Mind mind(value ? "add(Kf, p(a))" : "add(Kf, !p(a))", "", kAboutA);
    EXPECT_EQ(mind.Holds("K(p(a))"), value);
    EXPECT_EQ(mind.Holds("K(!p(a))"), !value);
    EXPECT_TRUE(mind.Holds("Kw(p(a))"));
    EXPECT_FALSE(mind.Holds("!Kw(p(a))"));
  }
}

TEST(Queries, SensedIsKnownWhetherAndNeitherTrueNorFalse) {
  const Mind mind("add(Kw, p(a))", "", kAboutA);
  EXPECT_TRUE(mind.Holds("Kw(p(a))"));
  EXPECT_FALSE(mind.Holds("K(p(a))"));
  EXPECT_FALSE(mind.Holds("K(!p(a))"));
}

TEST(Queries, ClosedWorldMakesFalseWhatIsNotKnown) {
  const std::vector<std::string> questions = {"K(!p(a))", "K(!p(b))", "K(p(b))", "Kw(q(a))"};
  const Mind mind("add(LCW, p(?x)), add(Kf, p(b))", "", questions);
  EXPECT_TRUE(mind.Holds("K(!p(a))"));
  EXPECT_FALSE(mind.Holds("K(!p(b))"));
  EXPECT_TRUE(mind.Holds("K(p(b))"));
  EXPECT_FALSE(mind.Holds("Kw(q(a))"));
}

TEST(Queries, DisjunctionIsOutsideOfK) {
  const std::string either = "K(p(a)) | K(p(b))";
  EXPECT_FALSE(Mind("add(Kx, p(a) | p(b))", "", {either}).Holds(either));
  EXPECT_TRUE(Mind("add(Kf, p(b))", "", {either}).Holds(either));
}

TEST(Queries, QuantifiersRangeOverConstants) {
  const std::string all = "forallK(?x: thing) (K(p(?x)) | K(q(?x)))";
  const std::string some = "existsK(?x: thing) (K(p(?x)) & K(q(?x)))";
  const Mind each("add(Kf, p(a)), add(Kf, q(b)), add(Kf, p(c))", "", {all, some});
  EXPECT_TRUE(each.Holds(all));
  EXPECT_FALSE(each.Holds(some));
  const Mind one("add(Kf, p(a)), add(Kf, q(a))", "", {all, some});
  EXPECT_FALSE(one.Holds(all));
  EXPECT_TRUE(one.Holds(some));
}

TEST(Functions, HaveOneValueUnderUniqueNames) {
  // The question means that both are at the same place: functions are compared by their values.
  const std::string together = "existsK(?x: thing) (K(at(a) = ?x) & K(at(b) = ?x))";
  const std::vector<std::string> questions = {"K(at(a) = b)", "K(at(a) = c)", "K(at(a) != c)",
                                              "Kv(at(a))",    "Kv(at(b))",    together};
  const Mind mind("add(Kf, at(a) = b)", "", questions);
  EXPECT_TRUE(mind.Holds("K(at(a) = b)"));
  EXPECT_FALSE(mind.Holds("K(at(a) = c)"));
  EXPECT_TRUE(mind.Holds("K(at(a) != c)"));
  EXPECT_TRUE(mind.Holds("Kv(at(a))"));
  EXPECT_FALSE(mind.Holds("Kv(at(b))"));
  EXPECT_FALSE(mind.Holds(together));
  EXPECT_TRUE(Mind("add(Kf, at(a) = b), add(Kf, at(b) = b)", "", {together}).Holds(together));
}

TEST(Functions, AddingAValueRemovesTheOthersDeletingLeavesUnknown) {
  const std::vector<std::string> questions = {"K(at(a) = b)", "K(at(a) = c)", "K(at(a) != b)",
                                              "Kv(at(a))"};
  const std::string actions =
      "action move effects: add(Kf, at(a) = c)\n"
      "action lose effects: del(Kf, at(a) = c)\n";
  Mind mind("add(Kf, at(a) = b)", actions, questions);
  mind.Do("move");
  EXPECT_TRUE(mind.Holds("K(at(a) = c)"));
  EXPECT_TRUE(mind.Holds("K(at(a) != b)"));
  mind.Do("lose");
  EXPECT_FALSE(mind.Holds("K(at(a) = c)"));
  EXPECT_FALSE(mind.Holds("K(at(a) != b)"));
  EXPECT_FALSE(mind.Holds("Kv(at(a))"));
}

TEST(Kf, AddingALiteralRemovesItsComplementAndKw) {
  Mind mind("add(Kf, !p(a)), add(Kw, q(a))",
            "action make effects: add(Kf, p(a)), add(Kf, q(a))\n"
            "action spoil effects: del(Kf, q(a))\n",
            {"K(p(a))", "K(!p(a))", "K(q(a))", "Kw(q(a))"});
  mind.Do("make");
  EXPECT_TRUE(mind.Holds("K(p(a))"));
  EXPECT_FALSE(mind.Holds("K(!p(a))"));
  EXPECT_TRUE(mind.Holds("K(q(a))"));
  mind.Do("spoil");  // the first sensing is now out of date
  EXPECT_FALSE(mind.Holds("Kw(q(a))"));
}

TEST(Kf, ConditionsAreThoseBeforeTheAction) {
  Mind mind("add(Kf, p(a)), add(Kf, !q(a)), add(Kf, !r)",
            "action both effects: K(p(a)) => add(Kf, q(a)); K(q(a)) => add(Kf, r);"
            " add(Kf, !p(a))\n",
            {"K(q(a))", "K(r)", "K(!p(a))"});
  mind.Do("both");
  EXPECT_TRUE(mind.Holds("K(q(a))"));
  EXPECT_TRUE(mind.Holds("K(!p(a))"));
  EXPECT_FALSE(mind.Holds("K(r)"));
}

TEST(Kw, BranchesWhereItIsUndetermined) {
  Mind mind("add(Kf, q(a))", "action look effects: add(Kw, p(a)), add(Kw, q(a))\n", kAboutA);
  mind.Do("look");
  EXPECT_EQ(mind.Branch(false), "p(a)");
  EXPECT_TRUE(mind.Holds("K(!p(a))"));
  EXPECT_EQ(mind.Branch(true), "");
}

TEST(Kw, AConjunctionIsSettledByWhatIsLearnedOfItsAtoms) {
  const std::vector<std::string> questions = {"Kw(p(a) & q(a))", "Kw(p(a))", "K(q(a))"};
  const std::string look = "action look effects: add(Kw, p(a) & q(a))\n";
  Mind mind("add(Kf, !r)", look, questions);
  mind.Do("look");
  EXPECT_TRUE(mind.Holds("Kw(p(a) & q(a))"));
  EXPECT_FALSE(mind.Holds("Kw(p(a))"));
  mind.Learn("p(a)", true);
  EXPECT_EQ(mind.Branch(true), "p(a) & q(a)");
  EXPECT_TRUE(mind.Holds("K(q(a))"));
  // A false atom decides the conjunction.
  Mind other("add(Kf, !r)", look, questions);
  other.Do("look");
  other.Learn("p(a)", false);
  EXPECT_TRUE(other.Holds("Kw(p(a) & q(a))"));
  EXPECT_EQ(other.Branch(true), "");
}

TEST(Kw, IsOfOneFormulaHoweverItIsWritten) {
  const std::vector<std::string> questions = {"Kw(p(a))", "Kw(!q(a))", "Kw(q(a) & p(a))",
                                              "Kw(p(b) & !p(b))", "Kw(at(a) = b & at(a) = c)"};
  Mind mind("add(Kf, !r)", "action look effects: add(Kw, !p(a)), add(Kw, p(a) & q(a) & p(a))\n",
            questions);
  EXPECT_FALSE(mind.Holds("Kw(p(a))"));
  EXPECT_FALSE(mind.Holds("Kw(q(a) & p(a))"));
  mind.Do("look");
  EXPECT_TRUE(mind.Holds("Kw(p(a))"));
  EXPECT_TRUE(mind.Holds("Kw(q(a) & p(a))"));
  EXPECT_FALSE(mind.Holds("Kw(!q(a))"));
  EXPECT_EQ(mind.Branch(true), "p(a)");
  EXPECT_EQ(mind.Branch(true), "p(a) & q(a)");
  EXPECT_TRUE(mind.Holds("Kw(!q(a))"));
  // Formulas that can never hold are known to be false, so that these questions are answered at
  // once.
  EXPECT_TRUE(mind.Asks("Kw(p(b) & !p(b))").IsTrue());
  EXPECT_TRUE(mind.Asks("Kw(at(a) = b & at(a) = c)").IsTrue());
}

// A conjunction that is false does not tell which of its atoms is false.
TEST(Kw, AConjunctionOfSeveralUnknownsIsLearnedAsAWhole) {
  const std::vector<std::string> questions = {"Kw(p(a))", "Kw(q(a))", "K(p(a) & q(a))", "K(!q(a))",
                                              "Kw(p(a) & q(a))"};
  const std::string look = "action look effects: add(Kw, p(a) & q(a))\n";
  Mind mind("add(Kf, !r)", look, questions);
  mind.Do("look");
  mind.LearnSensed(true);
  EXPECT_TRUE(mind.Holds("K(p(a) & q(a))"));
  Mind other("add(Kf, !r)", look, questions);
  other.Do("look");
  other.LearnSensed(false);
  EXPECT_EQ(other.Branch(true), "");
  EXPECT_FALSE(other.Holds("Kw(p(a))"));
  EXPECT_FALSE(other.Holds("Kw(q(a))"));
  EXPECT_TRUE(other.Holds("Kw(p(a) & q(a))"));
  other.Learn("p(a)", true);
  EXPECT_TRUE(other.Holds("K(!q(a))"));
}

TEST(Kv, BranchesWhereTheRangeIsKnown) {
  const std::string read = "action read effects: add(Kv, at(a))\n";
  Mind known("add(Kx, at(a) = a | at(a) = c)", read, {"Kv(at(a))", "K(at(a) != b)"});
  EXPECT_FALSE(known.Holds("Kv(at(a))"));
  EXPECT_TRUE(known.Holds("K(at(a) != b)"));
  known.Do("read");
  EXPECT_TRUE(known.Holds("Kv(at(a))"));
  EXPECT_THAT(known.ValuesToBranch(), testing::ElementsAre("at(a) = a", "at(a) = c"));
  Mind unknown("add(Kf, !r)", read, {"Kv(at(a))"});
  unknown.Do("read");
  EXPECT_TRUE(unknown.Holds("Kv(at(a))"));
  EXPECT_THAT(unknown.ValuesToBranch(), IsEmpty());
}

TEST(Kx, AMemberKnownFalseIsDroppedTheLastIsKnown) {
  Mind mind("add(Kx, p(a) | p(b) | p(c))", "", {"K(p(c))", "Kw(p(c))"});
  EXPECT_THAT(mind.state().relations, SizeIs(1));
  mind.Learn("p(a)", false);
  EXPECT_FALSE(mind.Holds("Kw(p(c))"));
  mind.Learn("p(b)", false);
  EXPECT_TRUE(mind.Holds("K(p(c))"));
  EXPECT_THAT(mind.state().relations, IsEmpty());
}

TEST(Kx, AMemberKnownTrueMakesTheOthersFalse) {
  Mind mind("add(Kx, p(a) | p(b) | p(c))", "", {"K(!p(a))", "K(!p(c))"});
  mind.Learn("p(b)", true);
  EXPECT_TRUE(mind.Holds("K(!p(a))"));
  EXPECT_TRUE(mind.Holds("K(!p(c))"));
  EXPECT_THAT(mind.state().relations, IsEmpty());
}

TEST(Kx, ChangingAMemberEndsTheAlternatives) {
  Mind mind("add(Kx, p(a) | p(b))", "action make effects: add(Kf, p(a))\n",
            {"K(p(a))", "Kw(p(b))"});
  mind.Do("make");
  EXPECT_TRUE(mind.Holds("K(p(a))"));
  EXPECT_FALSE(mind.Holds("Kw(p(b))"));  // p(b) may be the true one
}

// The relation concerns the functions and values for which the parameters of the action stand, here
// a.
TEST(Kx, AnActionTellsOfItsParameters) {
  Mind mind("add(Kf, at(a) != b)",
            "action tell(?x: thing) effects: add(Kx, at(?x) = b | ?x = at(?x))\n",
            {"K(at(a) = a)", "K(at(b) = b)"});
  mind.Do("tell");
  EXPECT_TRUE(mind.Holds("K(at(a) = a)"));
  EXPECT_FALSE(mind.Holds("K(at(b) = b)"));
}

TEST(Kx, AnAlternativeThatIsSaidTwiceIsOne) {
  Mind mind("add(Kx, p(a) | p(b) | p(a)), add(Kf, !p(b))",
            "action tell(?x: thing, ?y: thing) effects: add(Kx, q(?x) | q(?y))\n",
            {"K(p(a))", "K(q(a))"});
  EXPECT_TRUE(mind.Holds("K(p(a))"));
  mind.Do("tell");
  EXPECT_TRUE(mind.Holds("K(q(a))"));
}

// Whoever executes the action does not know that the condition holds.
TEST(Kx, IsNotToldUnderAConditionThatIsNotKnown) {
  const std::string tell = "action tell effects: K(p(b)) => add(Kx, p(a) | q(a))\n";
  const std::vector<std::string> questions = {"K(p(a))", "K(!p(b))"};
  Mind mind("add(Kf, !q(a))", tell, questions);
  mind.Do("tell");
  EXPECT_FALSE(mind.Holds("K(p(a))"));
  mind.Learn("p(a)", false);
  EXPECT_FALSE(mind.Holds("K(!p(b))"));
  Mind told("add(Kf, !q(a)), add(Kf, p(b))", tell, questions);
  told.Do("tell");
  EXPECT_TRUE(told.Holds("K(p(a))"));
}

TEST(Kx, ContradictionsAreNamed) {
  EXPECT_THAT(MessageOf([] { Mind("add(Kf, !p(a)), add(Kf, !p(b)), add(Kx, p(a) | p(b))"); }),
              HasSubstr("problem.pks:1:88: this contradicts what is known"));
}

TEST(Updates, ApplyUntilNothingChanges) {
  const std::string rules =
      "action make effects: add(Kf, p(a))\n"
      "updates: K(q(a)) => add(Kf, q(b)); K(p(a)) => add(Kf, q(a)); K(q(b)) => add(Kf, q(c))\n";
  Mind mind("add(Kf, !p(a))", rules, {"K(q(c))"});
  EXPECT_FALSE(mind.Holds("K(q(c))"));
  mind.Do("make");
  EXPECT_TRUE(mind.Holds("K(q(c))"));
}

// After "where p(a), r" there are three cases. Case (a): r was false before and is true now, so
// p(a) held.
TEST(Postdiction, AnEffectTellsItsCondition) {
  const std::string press = "action press effects: K(p(a)) => add(Kf, r); add(Kw, r)\n";
  Mind mind("add(Kf, !r)", press, kAboutA);
  mind.Do("press");
  EXPECT_EQ(mind.Branch(true), "r");
  EXPECT_TRUE(mind.Holds("K(p(a))"));
  // Case (b): r is false now, so p(a) did not hold.
  Mind other("add(Kf, !r)", press, kAboutA);
  other.Do("press");
  other.Branch(false);
  EXPECT_TRUE(other.Holds("K(!p(a))"));
  // Case (c): r was unknown before, so that it tells nothing about p(a).
  Mind third("add(Kf, q(a))", press, kAboutA);
  third.Do("press");
  third.Branch(true);
  EXPECT_FALSE(third.Holds("Kw(p(a))"));
}

TEST(Postdiction, ThePastPersistsUntilItIsChanged) {
  const std::string actions =
      "action press effects: K(p(a)) => add(Kf, r)\n"
      "action wait effects: add(Kf, q(a))\n"
      "action spoil effects: del(Kf, p(a))\n"
      "action look effects: add(Kw, r)\n";
  Mind mind("add(Kf, !r), add(Kf, !q(a))", actions, kAboutA);
  for (const char* action : {"press", "wait", "look"}) mind.Do(action);
  mind.Branch(true);
  EXPECT_TRUE(mind.Holds("K(p(a))"));
  Mind spoiled("add(Kf, !r), add(Kf, !q(a))", actions, kAboutA);
  for (const char* action : {"press", "spoil", "look"}) spoiled.Do(action);
  spoiled.Branch(true);
  EXPECT_FALSE(spoiled.Holds("Kw(p(a))"));
}

// If the condition did not hold, what was known before is known again. If it held, nothing is
// known.
TEST(Postdiction, OfWhatIsDeletedUnderACondition) {
  const std::string actions =
      "action spill effects: K(q(a)) => del(Kf, p(a))\n"
      "action look effects: add(Kw, p(a))\n";
  const std::vector<std::string> questions = {"K(p(a))", "Kw(p(a))", "K(q(a))"};
  Mind spared("add(Kf, p(a))", actions, questions);
  spared.Do("spill");
  EXPECT_FALSE(spared.Holds("Kw(p(a))"));
  spared.Learn("q(a)", false);
  EXPECT_TRUE(spared.Holds("K(p(a))"));
  Mind spilled("add(Kf, p(a))", actions, questions);
  spilled.Do("spill");
  spilled.Learn("q(a)", true);
  EXPECT_FALSE(spilled.Holds("Kw(p(a))"));
  Mind looking("add(Kf, p(a))", actions, questions);
  looking.Do("spill");
  looking.Do("look");
  looking.Branch(false);
  EXPECT_TRUE(looking.Holds("K(q(a))"));
}

TEST(Intervals, KnownByTheirEnds) {
  const std::vector<std::string> questions = {
      "K(weight(a) > 2)", "K(weight(a) >= 2)", "K(weight(a) <= 4)", "K(weight(a) < 4)",
      "K(weight(a) > 3)", "Kw(weight(a) > 3)", "Kw(weight(a) > 5)"};
  const Mind mind("add(Kf, weight(a) = [2, 4])", "", questions);
  EXPECT_FALSE(mind.Holds("K(weight(a) > 2)"));
  EXPECT_TRUE(mind.Holds("K(weight(a) >= 2)"));
  EXPECT_TRUE(mind.Holds("K(weight(a) <= 4)"));
  EXPECT_FALSE(mind.Holds("K(weight(a) < 4)"));
  EXPECT_FALSE(mind.Holds("K(weight(a) > 3)"));
  EXPECT_FALSE(mind.Holds("Kw(weight(a) > 3)"));
  EXPECT_TRUE(mind.Holds("Kw(weight(a) > 5)"));  // the formula is known to be false
}

TEST(Intervals, SensingSplitsAndActionsShift) {
  const std::vector<std::string> questions = {"K(weight(a) > 3)", "K(weight(a) <= 3)",
                                              "K(weight(a) > 4)", "K(weight(a) <= 6)"};
  const std::string actions =
      "action weigh effects: add(Kw, weight(a) > 3)\n"
      "action fill effects: add(Kf, weight(a) = weight(a) + [1, 2])\n"
      "action lookCloser effects: add(Kf, weight(a) <= 5.5)\n";
  Mind heavy("add(Kf, weight(a) = [2, 4])", actions, questions);
  heavy.Do("weigh");
  EXPECT_EQ(heavy.Branch(true), "weight(a) > 3");
  EXPECT_EQ(heavy.state().ranges.front(), (Range{3, 4, true, false}));
  EXPECT_TRUE(heavy.Holds("K(weight(a) > 3)"));
  heavy.Do("fill");
  EXPECT_EQ(heavy.state().ranges.front(), (Range{4, 6, true, false}));
  EXPECT_TRUE(heavy.Holds("K(weight(a) > 4)"));
  EXPECT_TRUE(heavy.Holds("K(weight(a) <= 6)"));
  heavy.Do("lookCloser");
  EXPECT_EQ(heavy.state().ranges.front(), (Range{4, 5.5, true, false}));
  Mind light("add(Kf, weight(a) = [2, 4])", actions, questions);
  light.Do("weigh");
  light.Branch(false);
  EXPECT_EQ(light.state().ranges.front(), (Range{2, 3, false, false}));
  EXPECT_TRUE(light.Holds("K(weight(a) <= 3)"));
}

// A sensor with an error of at most e gives an interval of width 2 e at run time.
TEST(Intervals, SensorsErr) {
  const std::vector<std::string> questions = {"Kv(weight(a))", "Kv(weight(a) within 0.1)",
                                              "Kv(weight(a) within 0.5)", "Kv(weight(a) within 1)"};
  Mind mind("add(Kf, weight(a) = [2, 4])",
            "action guess effects: add(Kv, weight(a) within 0.5)\n"
            "action weigh effects: add(Kv, weight(a) within 0.1)\n"
            "action fill effects: add(Kf, weight(a) = weight(a) + 1)\n",
            questions);
  const auto holds = [&] {
    std::string text;
    for (const std::string& question : questions) text += mind.Holds(question) ? '1' : '0';
    return text;
  };
  EXPECT_EQ(holds(), "0001");  // the interval is 2 wide, which is within 1
  mind.Do("guess");
  EXPECT_EQ(holds(), "1011");
  mind.Do("weigh");
  EXPECT_EQ(holds(), "1111");
  mind.Do("guess");  // a worse sensor takes nothing away
  EXPECT_EQ(holds(), "1111");
  mind.Do("fill");  // the sensing is out of date
  EXPECT_EQ(holds(), "0001");
}

// The init has the same effect as actions. The most precise of several sensors counts.
TEST(Intervals, WhatIsSensedAtFirstErrsAsAfterAnAction) {
  const std::string interval = "add(Kf, weight(a) = [2, 4])";
  const std::string actions =
      "action guess effects: add(Kv, weight(a) within 0.5)\n"
      "action weigh effects: add(Kv, weight(a) within 0.1)\n";
  const std::vector<std::string> questions = {"Kv(weight(a) within 0.1)",
                                              "Kv(weight(a) within 0.5)"};
  Mind mind(interval, actions, questions);
  mind.Do("guess");
  const std::string guessed = interval + ", add(Kv, weight(a) within 0.5)";
  EXPECT_EQ(Mind(guessed, actions, questions).state(), mind.state());
  mind.Do("weigh");
  for (const char* weighed : {", add(Kv, weight(a) within 0.1)",
                              ", add(Kv, weight(a) within 0.2), "
                              "add(Kv, weight(a) within 0.1)"}) {
    EXPECT_EQ(Mind(guessed + weighed, actions, questions).state(), mind.state());
  }
}

TEST(Intervals, AreSensedAfterTheyAreChanged) {
  Mind mind("add(Kf, weight(a) = [2, 4])",
            "action pour effects: add(Kv, weight(a)), add(Kf, weight(a) = weight(a) + 1)\n",
            {"Kv(weight(a))"});
  mind.Do("pour");
  EXPECT_TRUE(mind.Holds("Kv(weight(a))"));
}

// The new value of a number depends on the condition, and a sum depends on its parts. More may be
// known about these numbers than their intervals show. The planner therefore never claims that
// something is unknown.
TEST(Intervals, ThatHangTogetherAreNotSaidToBeUnknown) {
  const std::vector<std::string> questions = {"K(weight(a) <= 3)", "!K(weight(a) <= 2)",
                                              "!K(weight(a) <= 0)", "!K(weight(b) <= 2)"};
  const std::string actions =
      "action fill effects: K(p(a)) => add(Kf, weight(a) = weight(a) + 2)\n"
      "action copy effects: add(Kf, weight(a) = weight(b) + 1)\n"
      "action grow effects: add(Kf, weight(a) = weight(a) + [0, 2])\n";
  Mind filled("add(Kf, weight(a) = 1)", actions, questions);
  filled.Do("fill");
  EXPECT_TRUE(filled.Holds("K(weight(a) <= 3)"));
  EXPECT_FALSE(filled.Holds("!K(weight(a) <= 2)"));
  EXPECT_TRUE(filled.Holds("!K(weight(a) <= 0)"));  // the number is surely not 0 or less
  Mind copied("add(Kf, weight(b) = [0, 4])", actions, questions);
  copied.Do("copy");
  EXPECT_FALSE(copied.Holds("!K(weight(a) <= 2)"));
  EXPECT_FALSE(copied.Holds("!K(weight(b) <= 2)"));
  Mind grown("add(Kf, weight(a) = 1)", actions, questions);
  grown.Do("grow");
  EXPECT_TRUE(grown.Holds("!K(weight(a) <= 2)"));
}

// After `fill` the number is 1 if p is false. If an action then adds that the number is more than
// 1, this either means that p is true or contradicts that p is false. The action is refused.
TEST(Intervals, ThatHangTogetherAreNotTold) {
  const GroundTask task = GroundText(
      "domain n predicates: p, g functions: n: number\n"
      "action fill effects: K(p) => add(Kf, n = 2)\n"
      "action tell effects: add(Kf, n > 1), add(Kf, g)\n"
      "action reset effects: add(Kf, n = [0, 3])\n",
      "problem n domain n init: add(Kf, n = 1), add(Kf, !g) goal: K(g)");
  KnowledgeBase knowledge(task);
  const auto filled = knowledge.After(task.actions[0], knowledge.Initial());
  ASSERT_TRUE(filled);
  EXPECT_FALSE(knowledge.After(task.actions[1], *filled));
  const auto reset = knowledge.After(task.actions[2], *filled);
  ASSERT_TRUE(reset);
  EXPECT_TRUE(knowledge.After(task.actions[1], *reset));
}

// The effect happens if the number is above 3, whether or not that is known.
TEST(Intervals, EffectsUnderBoundsMayHappen) {
  const std::vector<std::string> questions = {
      "K(p(a))",           "K(!p(a))",          "K(p(b))",          "K(q(b))",
      "K(!q(b))",          "K(p(c))",           "K(!p(c))",         "K(r)",
      "!K(weight(a) > 5)", "K(weight(b) >= 2)", "K(weight(b) <= 5)"};
  Mind mind(
      "add(LCW, p(?x)), add(LCW, q(?x)), add(Kf, weight(a) = [0, 10]), add(Kf, weight(b) = [2, 5])",
      "action weigh effects: K(weight(a) > 3) => add(Kf, p(a)), add(Kf, r);\n"
      "K(weight(a) > 5) => add(Kf, p(b)); K(weight(a) <= 3) => add(Kf, q(b)), add(Kf, r);\n"
      "K(weight(a) > 10) => add(Kf, p(c)); K(weight(a) > 3) => add(Kf, weight(b) = 0)\n",
      questions);
  mind.Do("weigh");
  EXPECT_FALSE(mind.Holds("K(p(a))"));
  EXPECT_FALSE(mind.Holds("K(!p(a))"));
  EXPECT_TRUE(mind.Holds("K(!p(c))"));
  EXPECT_TRUE(mind.Holds("K(r)"));  // one of the two effects makes it true
  EXPECT_FALSE(mind.Holds("K(weight(b) >= 2)"));
  EXPECT_TRUE(mind.Holds("K(weight(b) <= 5)"));
  // Learning an atom may tell something about the number.
  EXPECT_FALSE(mind.Holds("!K(weight(a) > 5)"));
  // A number above 5 is above 3, too.
  mind.Learn("p(b)", true);
  EXPECT_TRUE(mind.Holds("K(p(a))"));
  EXPECT_TRUE(mind.Holds("K(!q(b))"));
}

TEST(Intervals, ContradictionsAreNamed) {
  EXPECT_THAT(MessageOf([] { Mind mind("add(Kf, weight(a) > 3), add(Kf, weight(a) < 3)"); }),
              HasSubstr("this contradicts what is known: no number is left for weight(a)"));
  EXPECT_EQ(MessageOf([] { Mind mind("add(Kf, weight(a) >= 3), add(Kf, weight(a) <= 3)"); }),
            "no error");
}

TEST(Updates, ContradictionsAtFirstAreToldWithThePlaceOfTheRule) {
  const auto message = [](const std::string& rule, const std::string& init) {
    return MessageOf(
        [&] { Mind mind("add(Kf, p(a)), " + init, "updates: true => add(Kf, r);\n" + rule); });
  };
  const std::string told = "domain.pks:5:1: this update rule contradicts what is known at first";
  const std::string neither = "K(p(a)) => add(Kf, !q(a)), add(Kf, !q(b))";
  EXPECT_THAT(message(neither, "add(Kx, q(a) | q(b))"), HasSubstr(told));
  EXPECT_THAT(message(neither, "add(Kx, some(q(a) | q(b)))"), HasSubstr(told));
  EXPECT_EQ(message(neither, "add(Kx, q(a) | q(b) | q(c))"), "no error");
  EXPECT_EQ(message(neither, "add(Kx, p(b) | p(c))"), "no error");
  const std::string both = "K(p(a)) => add(Kf, q(a)), add(Kf, q(b))";
  EXPECT_THAT(message(both, "add(Kx, q(a) | q(b))"), HasSubstr(told));
  EXPECT_EQ(message(both, "add(Kx, some(q(a) | q(b)))"), "no error");
  // The facts contradict each other only together: q(b) would have to hold.
  EXPECT_THAT(message("K(p(a)) => add(Kf, !q(a)), add(Kf, !q(c))",
                      "add(Kx, q(a) | q(b)), add(Kx, q(b) | q(c)), add(Kx, some(!q(b) | q(c)))"),
              HasSubstr(told));
  EXPECT_THAT(message("K(p(a)) => add(Kx, q(a) | q(b))", "add(Kf, !q(a)), add(Kf, !q(b))"),
              HasSubstr(told));
  EXPECT_THAT(message("K(p(a)) => add(Kf, weight(a) > 3)", "add(Kf, weight(a) = 2)"),
              HasSubstr(told));
}

// An alternative that holds at first need not hold later, because a rule changes it.
TEST(Updates, MayChangeAlternativesLater) {
  Mind mind("add(Kx, q(a) | q(b))",
            "action act effects: add(Kf, p(a))\n"
            "updates: K(p(a)) => add(Kf, !q(a)), add(Kf, !q(b))",
            {"K(!q(a)) & K(!q(b))"});
  mind.Do("act");
  EXPECT_TRUE(mind.Holds("K(!q(a)) & K(!q(b))"));
}

// By the rule, a lit lamp would make a number greater than it is. No plan branches on it.
TEST(Updates, ThatContradictABranchLeaveItOut) {
  const GroundTask task = GroundText(
      "domain bell predicates: lit, g functions: n: number\n"
      "action look effects: add(Kw, lit)\n"
      "action end preconds: Kw(lit) effects: add(Kf, g)\n"
      "updates: K(lit) => add(Kf, n > 1)",
      "problem bell domain bell init: add(Kf, n = 1), add(Kf, !g) goal: K(g)");
  KnowledgeBase knowledge(task);
  const auto looked = knowledge.After(task.actions.front(), knowledge.Initial());
  ASSERT_TRUE(looked);
  const FormulaId lit = knowledge.FormulaToBranch(*looked);
  EXPECT_FALSE(knowledge.Learned(*looked, lit, true));
  EXPECT_TRUE(knowledge.Learned(*looked, lit, false));
  EXPECT_EQ(PlanFor(task, Wanted::kFirst).outcome, Outcome::kNone);
}

// Equal knowledge is equal data, whatever led to it.
TEST(States, AreCanonical) {
  const std::string actions =
      "action makeA effects: add(Kf, p(a))\n"
      "action makeB effects: add(Kf, p(b))\n";
  Mind one("add(Kx, q(a) | q(b) | q(c))", actions);
  Mind other("add(Kx, q(a) | q(b) | q(c))", actions);
  for (const char* action : {"makeA", "makeB"}) one.Do(action);
  one.Learn("q(a)", false);
  other.Learn("q(a)", false);
  for (const char* action : {"makeB", "makeA"}) other.Do(action);
  EXPECT_EQ(one.state(), other.state());
  EXPECT_EQ(HashOf(one.state()), HashOf(other.state()));
}

}  // namespace
}  // namespace assay::contingent::knowledge_base_test
