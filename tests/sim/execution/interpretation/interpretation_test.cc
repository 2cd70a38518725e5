#include "sim/execution/interpretation/interpretation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner/base/input_files/input_error.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "tests/sim/execution/two_cans.h"

namespace assay::execution::interpretation_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string ErrorOf(const Replacements& replacements) {
  try {
    TwoCans(replacements);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// Returns "two-cans.yaml:LINE:COLUMN: " for the place of `what` in the changed file.
std::string PlaceOf(const std::string& what, const Replacements& replacements) {
  const std::string text = TwoCansText(replacements);
  const std::size_t at = text.find(what);
  const std::size_t line_start = text.rfind('\n', at) + 1;
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  return "two-cans.yaml:" + std::to_string(line) + ":" + std::to_string(at - line_start + 1) + ": ";
}

TEST(Interpretation, OfTwoCans) {
  const KnowledgeScenario scenario = TwoCans();
  EXPECT_EQ(scenario.interpretation.skills.size(), 5u);
  EXPECT_EQ(scenario.interpretation.predicates.size(), 4u);
  EXPECT_EQ(scenario.interpretation.hidden.size(), 2u);
  EXPECT_TRUE(scenario.interpretation.spill);
}

struct Wrong {
  std::string from;
  std::string to;
  std::string place;    // the text at which the message points
  std::string message;  // a piece of the message
};

TEST(Interpretation, WrongFilesAreRefusedWithPlaceAndRemedy) {
  const std::vector<Wrong> wrongs = {
      {"{skill: pick-up}", "{skill: pick-pu}", "pick-pu", "pick-up"},
      {"{skill: pick-up}", "{skill: pick-up, to: table}", "to: table", "to"},
      {"to: second-table}", "to: third-table}", "third-table", "second-table"},
      {"carry, to: second-table}", "carry}", "{skill: carry}", "needs a table"},
      {"upright: 5", "upright: -5", "-5", "-5 deg is out of range; allowed: 0.1 deg to 90 deg"},
      {"error: 0.3", "error: -1", "-1}", "-1 N is out of range; allowed: 0 N to 50 N"},
      {"    ungrasp: {skill: put-down}\n", "", "grasp: {skill", "'ungrasp' has no skill"},
      {"    ungrasp:", "    ungrip:", "ungrip", "ungrasp"},
      {"{is: held}", "{is: hold}", "hold}", "held"},
      {"than: 0.25", "than: light", "light", "number"},
      {"    handEmpty: {is: hand-empty}\n", "", "isGrasped: {is", "'handEmpty' has no meaning"},
      {"handEmpty: {", "handFull: {", "handFull", "handEmpty"},
      {"handEmpty: {is: hand-empty}", "handEmpty: {is: held}", "{is: held}\n  hidden",
       "'handEmpty' needs a part"},
      {"{is: heavier, than: 0.25}", "{is: internal}", "{is: internal}\n    hand",
       "no sensor tells whether isSpillable(can1)"},
      {"{is: heavier, than: 0.25}", "{is: held}", "{is: held}\n    handEmpty",
       "no sensor tells whether isSpillable(can1)"},
      {"can1: {mass", "can3: {mass", "can3: {mass", "can1"},
      {"[0.06, 0.12]", "[0.12, 0.06]", "[0.12, 0.06]", "[low, high]"},
      {"if: isSpillable", "if: isSpilled", "isSpilled", "isSpillable"},
      {"beyond: 10", "beyond: 0", "0}\nsimulation",
       "0 deg is out of range; allowed: 0.01 deg to 180 deg"},
      {"  can2:\n", "  jar2:\n", "{skill: pick-up}", "named like the scenario's parts"},
      {"hidden:", "hiden:", "hiden", "hidden"},
  };
  for (const auto& [from, to, place, message] : wrongs) {
    const std::string error = ErrorOf({{from, to}});
    EXPECT_THAT(error, AllOf(HasSubstr(PlaceOf(place, {{from, to}})), HasSubstr(message)))
        << from << " -> " << to;
  }
}

// A predicate "part is over table" has two arguments, unless its meaning names the table. A
// predicate that says which parts spill must have a part as its only argument.
TEST(Interpretation, WhatSpillsIsAskedOfAPartAlone) {
  const auto error_of = [](const std::string& meaning) {
    const std::string domain = ScratchFile("placed.pks");
    std::ofstream(domain) << "domain placed\ntypes: object, place\n"
                             "predicates: isGrasped(object), isOn(object, place)\n"
                             "action grasp(?o: object)\n  preconds: K(!isGrasped(?o))\n"
                             "  effects: add(Kf, isGrasped(?o))\n";
    const std::string problem = ScratchFile("placed-problem.pks");
    std::ofstream(problem) << "problem p\ndomain placed\n"
                              "objects: can1: object, second-table: place\n"
                              "init: add(LCW, isGrasped(?o)), add(LCW, isOn(?o, ?p))\n"
                              "goal: K(isGrasped(can1)) & K(!isOn(can1, second-table))\n";
    const std::string text = TwoCansText();
    const std::string scenario = ScratchFile("placed.yaml");
    std::ofstream(scenario) << text.substr(0, text.find("knowledge:"))
                            << "knowledge:\n  domain: " << domain << "\n  problem: " << problem
                            << "\n  actions: {grasp: {skill: pick-up}}\n  predicates:\n"
                               "    isGrasped: {is: held}\n    isOn: "
                            << meaning << "\n  spills: {if: isOn, beyond: 10}\n";
    try {
      Load(scenario, kRoot / "models");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_of("{is: over}"), AllOf(HasSubstr("placed.yaml:"), HasSubstr(":16: "),
                                            HasSubstr("'isOn' needs a table beside the part")));
  EXPECT_EQ(error_of("{is: over, place: second-table}"), "no error");
}

TEST(Interpretation, TheDomainMustBeThere) {
  EXPECT_THAT(ErrorOf({{"force-sensing.pks", "force.pks"}}), HasSubstr("there is no file"));
}

TEST(Interpretation, InternalPredicatesMeanNothing) {
  const KnowledgeScenario scenario = TwoCans({{"{is: hand-empty}", "{is: internal}"}});
  EXPECT_EQ(scenario.interpretation.predicates.at("handEmpty"), nullptr);
}

}  // namespace
}  // namespace assay::execution::interpretation_test
