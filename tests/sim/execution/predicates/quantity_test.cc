#include "sim/execution/predicates/quantity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/base/input_files/input_error.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/execution/trial/tree_trial.h"
#include "sim/execution/walk/audit.h"
#include "tests/sim/execution/two_cans.h"

namespace assay::execution::quantity_test {
namespace {

using contingent::Relation;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

// The weight of a can is a number in this domain, and not a predicate.
constexpr const char* kDomain = R"(domain weighing
types: object
predicates: isGrasped(object), isRemoved(object), handEmpty
functions: weight(object): number
action grasp(?o: object)
  preconds: K(!isGrasped(?o)) & K(handEmpty)
  effects: add(Kf, isGrasped(?o)), add(Kf, !handEmpty)
action senseWeight(?o: object)
  preconds: !Kw(weight(?o) > 0.25) & K(isGrasped(?o))
  effects: add(Kw, weight(?o) > 0.25)
action transferUpright(?o: object)
  preconds: K(weight(?o) > 0.25) & K(isGrasped(?o)) & K(!isRemoved(?o))
  effects: add(Kf, isRemoved(?o))
action transfer(?o: object)
  preconds: K(weight(?o) <= 0.25) & K(isGrasped(?o)) & K(!isRemoved(?o))
  effects: add(Kf, isRemoved(?o))
action ungrasp(?o: object)
  preconds: K(isGrasped(?o))
  effects: add(Kf, !isGrasped(?o)), add(Kf, handEmpty)
)";
const std::string kMoved = "K(isRemoved(can1)) & K(!isGrasped(can1))";

KnowledgeScenario Weighing(const std::string& init, const std::string& goal,
                           const Replacements& more = {},
                           const std::string& domain_text = kDomain) {
  const std::filesystem::path domain = ScratchFile("weighing.pks");
  std::ofstream(domain) << domain_text;
  Replacements replacements = WithProblem(
      "problem p\ndomain weighing\nobjects: can1: object\n"
      "init: add(Kf, handEmpty), add(LCW, isGrasped(?o)), add(LCW, isRemoved(?o)), " +
      init + "\ngoal: " + goal + "\n");
  replacements.insert(replacements.end(),
                      {{kRoot / "scenarios/know/force-sensing.pks", domain},
                       {"isSpillable: {is: heavier, than: 0.25}", "weight: {is: mass}"},
                       {"  spills: {if: isSpillable, beyond: 10}\n", ""}});
  replacements.insert(replacements.end(), more.begin(), more.end());
  return TwoCans(replacements);
}

TreeTrial RunTree(const KnowledgeScenario& scenario, double mass) {
  return RunTrial(scenario, TreeOf(scenario), {1, {.masses = {{PartId(0), mass}}}}, {});
}

// The initial knowledge state, in a simulation in which can1 weighs 0.42 kg.
struct AtFirst {
  explicit AtFirst(const std::string& init, const std::string& goal = kMoved)
      : scenario(Weighing(init, goal)) {}

  std::vector<FalseClaim> FalseClaims(const Readings& readings = {}) {
    return audit.FalseClaims(knowledge, state, truth, readings, 0);
  }

  const KnowledgeScenario scenario;
  const domain::Problem& problem = scenario.scenario.problem;
  const scene::Scene scene{problem, {.part_masses = {{PartId(0), 0.42}}}};
  const mujoco::Data data = scene.Start();
  const Truth truth{problem, scene, data};
  const Audit audit{scenario.interpretation, problem};
  contingent::KnowledgeBase knowledge{scenario.interpretation.task};
  contingent::KnowledgeState state = knowledge.Initial();
};

TEST(Quantity, ABoundIsToldUnlessItIsWithinTheError) {
  const contingent::Bound above = {.function = {}, .relation = Relation::kGreater, .value = 0.25};
  const contingent::Bound below = {
      .function = {}, .relation = Relation::kLessOrEqual, .value = 0.25};
  for (const auto& [value, is_above] :
       {std::pair(0.29, std::optional(true)), std::pair(0.21, std::optional(false)),
        std::pair(0.27, std::optional<bool>()), std::pair(0.23, std::optional<bool>())}) {
    EXPECT_EQ(Observed(above, {value, 0.03}), is_above) << value;
    EXPECT_EQ(Observed(below, {value, 0.03}), is_above ? std::optional(!*is_above) : std::nullopt);
    EXPECT_EQ(Holds(above, value), value > 0.25);
    EXPECT_EQ(Holds(below, value), value <= 0.25);
  }
}

TEST(Quantity, ABoundHoldsWhereItIsSaidTo) {
  for (const Relation relation :
       {Relation::kLess, Relation::kLessOrEqual, Relation::kGreater, Relation::kGreaterOrEqual}) {
    const contingent::Bound bound = {.function = {}, .relation = relation, .value = 0.25};
    const Interval where = WhereHolds(bound);
    for (const double value : {0.1, std::nextafter(0.25, 0), 0.25, std::nextafter(0.25, 1), 0.4}) {
      EXPECT_EQ(value >= where.low && value <= where.high, Holds(bound, value)) << value;
    }
  }
}

TEST(Quantity, AnIntervalWithoutTheTrueValueIsAFalseClaim) {
  for (const char* init : {"add(Kf, weight(can1) = [0.4, 0.45])", "add(Kf, weight(can1) > 0.4)",
                           "add(Kf, weight(can1) = [0, 1])"}) {
    EXPECT_THAT(AtFirst(init).FalseClaims(), IsEmpty()) << init;
  }
  const auto claims = AtFirst("add(Kf, weight(can1) = [0.6, 0.7])").FalseClaims();
  ASSERT_THAT(claims, ElementsAre(Field(&FalseClaim::atom, "weight(can1) = [0.6, 0.7]")));
  EXPECT_EQ(claims.front().truth, "it is 0.420");
  EXPECT_THAT(AtFirst("add(Kf, weight(can1) < 0.4)").FalseClaims(),
              ElementsAre(Field(&FalseClaim::atom, "weight(can1) < 0.4")));
}

TEST(Quantity, ASensedValueIsReadWithinItsErrorOrAFalseClaim) {
  AtFirst at_first("add(Kv, weight(can1) within 0.05)");
  const auto read = [](double mass) {
    Readings readings;
    readings.masses[PartId(0)] = {.value = mass, .error = 0.05};
    return readings;
  };
  EXPECT_THAT(at_first.FalseClaims(read(0.46)), IsEmpty());
  EXPECT_THAT(at_first.FalseClaims(read(0.38)), IsEmpty());
  EXPECT_THAT(at_first.FalseClaims(read(0.48)),
              ElementsAre(Field(&FalseClaim::atom, "Kv(weight(can1) within 0.05)")));
  EXPECT_THAT(at_first.FalseClaims(),
              ElementsAre(Field(&FalseClaim::truth, "nothing has told it")));
}

TEST(Quantity, GoalsOnNumbersAreJudgedByTheTruth) {
  const std::string init = "add(Kf, weight(can1) = [0, 1])";
  const auto is_true = [&](const std::string& goal) {
    const AtFirst at_first(init, goal);
    return at_first.audit.IsGoalTrue(at_first.truth);
  };
  EXPECT_TRUE(is_true("K(weight(can1) > 0.4)"));
  EXPECT_TRUE(is_true("K(weight(can1) <= 0.43)"));
  EXPECT_FALSE(is_true("K(weight(can1) > 0.5)"));
  EXPECT_FALSE(is_true("K(weight(can1) > 0.4) & K(weight(can1) < 0.41)"));
}

// The planner uses the known interval and leaves out the weighing.
TEST(Quantity, AFalseIntervalFailsATrialThatReachesItsGoal) {
  const TreeTrial trial = RunTree(Weighing("add(Kf, weight(can1) = [0.6, 0.7])", kMoved), 0.42);
  EXPECT_EQ(trial.outcome, TrialOutcome::kFalseClaim);
  EXPECT_TRUE(trial.is_goal_true);
  EXPECT_THAT(trial.reason,
              HasSubstr("after step 0 weight(can1) = [0.6, 0.7] is claimed to be true and is "
                        "false: it is 0.420"));
}

TEST(Quantity, WeighingTellsOnWhichSideOfABoundItIs) {
  const KnowledgeScenario scenario = Weighing("add(Kf, weight(can1) = [0, 1])", kMoved);
  for (const auto& [mass, action] :
       {std::pair(0.42, "transferUpright(can1)"), std::pair(0.1, "transfer(can1)")}) {
    const TreeTrial trial = RunTree(scenario, mass);
    EXPECT_EQ(trial.outcome, TrialOutcome::kSucceeded) << trial.reason;
    ASSERT_EQ(trial.walk.steps.size(), 4u);
    EXPECT_EQ(trial.walk.steps[2].action, action);
  }
  const TreeTrial flipped = RunTrial(scenario, TreeOf(scenario),
                                     {1, {.masses = {{PartId(0), 0.42}}}}, {.sensing_errors = 1});
  EXPECT_EQ(flipped.outcome, TrialOutcome::kFalseClaim);
}

TEST(Quantity, LeavesDrawMassesOnTheirSideOfABound) {
  const KnowledgeScenario scenario = Weighing("add(Kf, weight(can1) = [0, 1])", kMoved);
  const auto leaves = LeavesOf(scenario.interpretation.task, TreeOf(scenario), 10);
  ASSERT_EQ(leaves.size(), 2u);
  RandomStream random(1, "worlds");
  for (int i = 0; i < 2; ++i) {
    const auto world =
        WorldFor(leaves[i], scenario.interpretation, scenario.scenario.problem, random);
    ASSERT_TRUE(world);
    EXPECT_EQ(world->masses.at(PartId(0)) > 0.25, i == 0);
  }
}

// The plan ends with the weighing. No branch depends on the result.
TEST(Quantity, WhatTheGoalTakesForSensedMustHaveBeenTold) {
  const char* init = "add(Kf, weight(can1) = [0, 1])";
  const char* goal = "Kw(weight(can1) > 0.25)";
  EXPECT_EQ(RunTree(Weighing(init, goal), 0.42).outcome, TrialOutcome::kSucceeded);
  const TreeTrial blind = RunTree(Weighing(init, goal, {{"error: 0.3", "error: 20"}}), 0.42);
  EXPECT_EQ(blind.outcome, TrialOutcome::kUncertain);
  EXPECT_THAT(blind.reason, HasSubstr("do not tell whether weight(can1) > 0.25"));
}

// No branch depends on the reading.
TEST(Quantity, AReadingThatIsMadeWrongIsToldByTheAudit) {
  const std::string text = kDomain;
  const std::size_t begin = text.find("action senseWeight");
  const std::size_t end = text.find("action transferUpright");
  const std::string domain = text.substr(0, begin) +
                             "action senseWeight(?o: object)\n"
                             "  preconds: K(isGrasped(?o))\n"
                             "  effects: add(Kv, weight(?o) within 0.05)\n" +
                             text.substr(end);
  const KnowledgeScenario scenario =
      Weighing("add(Kf, weight(can1) = [0, 1])", "Kv(weight(can1) within 0.05)", {}, domain);
  EXPECT_EQ(RunTree(scenario, 0.42).outcome, TrialOutcome::kSucceeded);
  const TreeTrial wrong = RunTrial(scenario, TreeOf(scenario), {1, {.masses = {{PartId(0), 0.42}}}},
                                   {.sensing_errors = 1});
  EXPECT_TRUE(wrong.walk.is_flipped);
  EXPECT_EQ(wrong.outcome, TrialOutcome::kFalseClaim);
  EXPECT_THAT(wrong.reason, HasSubstr("Kv(weight(can1) within 0.05)"));
}

TEST(Quantity, ANumberThatIsSensedNeedsAMeaning) {
  const auto error_of = [](const char* meaning) {
    try {
      Weighing("add(Kf, weight(can1) = [0, 1])", kMoved, {{"    weight: {is: mass}", meaning}});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_of("    weight: {is: internal}"),
              HasSubstr("no sensor tells whether weight(can1) > 0.25"));
  EXPECT_THAT(error_of(""), HasSubstr("'weight' has no meaning"));
  EXPECT_THAT(error_of("    weight: {is: held}"), HasSubstr("mass"));
}

}  // namespace
}  // namespace assay::execution::quantity_test
