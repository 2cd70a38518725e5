#include "planner/plan/certificates/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "planner/plan/checker/checker.h"
#include "tests/planner/plan/peg_and_block.h"

namespace assay::plan::coverage_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::json;

// Returns a step of each kind by the name of its action.
const std::map<std::string, PlannedStep>& Steps() {
  static const std::map<std::string, PlannedStep> steps = [] {
    std::map<std::string, PlannedStep> all;
    all["pickup"].action = Action{.kind = &domain::kPickup};
    all["putdown"].action = Action{.kind = &domain::kPutdown};
    all["assemble"].action = Action{.kind = &domain::kAssemble};
    all["felt in"].action = Action{.kind = &domain::kAssemble};
    all["felt in"].strategy = Strategy{};
    all["sense"].action = Action{.kind = &domain::kSense};
    all["squeeze"].action = Action{.kind = &domain::kSqueeze};
    return all;
  }();
  return steps;
}

std::vector<Condition> ConditionsNeeded(const PlannedStep& step) {
  return plan::ConditionsNeeded(step.action, step.strategy ? &*step.strategy : nullptr);
}

std::vector<std::string> NamesNeeded(const PlannedStep& step) {
  std::vector<std::string> names;
  for (const Condition condition : ConditionsNeeded(step)) names.emplace_back(condition.name());
  return names;
}

// Adds one precondition of each kind that the step needs.
PlannedStep Covered(PlannedStep step) {
  for (const Condition condition : ConditionsNeeded(step)) {
    step.certificate.preconditions.push_back({.condition = condition});
  }
  return step;
}

TEST(ConditionKind, WhatActsNeedsAndWhatLooksDoesNot) {
  EXPECT_THAT(NamesNeeded(Steps().at("sense")), ElementsAre("reach", "way clear"));
  EXPECT_THAT(NamesNeeded(Steps().at("squeeze")),
              ElementsAre("between fingers", "finger clear", "fingertip", "pad contact", "upright",
                          "pushed clear", "hand clear", "reach", "way clear"));
  EXPECT_THAT(NamesNeeded(Steps().at("assemble")),
              ElementsAre("fingertip", "entry", "slide-in", "tilt", "seat", "passing clear",
                          "fixed stands", "fixed stays", "in place", "standing", "pressed",
                          "holding", "hand clear", "reach", "way clear"));
  EXPECT_THAT(NamesNeeded(Steps().at("felt in")),
              ElementsAre("fingertip", "entry", "slide-in", "tilt", "seat", "passing clear",
                          "fixed stands", "fixed stays", "in place", "tip shift", "tip turn",
                          "standing", "pressed", "holding", "hand clear", "reach", "way clear"));
}

// A kind is a piece of data. Two kinds are the same only if they are one object.
TEST(ConditionKind, NamesAreUniqueAndEveryKindIsExplained) {
  const std::vector<std::string> names = NamesOfConditions(KnownConditions());
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  for (const ConditionKind* kind : KnownConditions()) {
    EXPECT_THAT(kind->meaning, testing::Not(IsEmpty())) << kind->name;
    const ConditionKind alike = *kind;
    EXPECT_EQ(Condition(*kind), Condition(*kind));
    EXPECT_NE(Condition(*kind), Condition(alike));
  }
}

TEST(ConditionKind, FineMotionAbsorbsWhatAShaftNeedsInItsHole) {
  const std::vector<Condition> of_the_shaft = {condition::kEntry, condition::kSlideIn,
                                               condition::kTilt, condition::kSeat};
  EXPECT_EQ(AbsorbedByFineMotion(), of_the_shaft);
}

TEST(ErrorKind, IsReadFromTheNamesOfItsVariables) {
  for (const ErrorKind* kind : KnownErrors()) {
    for (const char* of : {"_block", "_hand", "_peg_2", "_drag_peg"}) {
      const ErrorKind* read = ErrorKindOf(std::string(kind->stem) + of);
      ASSERT_NE(read, nullptr) << kind->stem << of;
      EXPECT_EQ(read->dimension, kind->dimension) << kind->stem << of;
    }
  }
  EXPECT_EQ(ErrorKindOf("theta"), nullptr) << "it belongs to nothing";
  EXPECT_EQ(ErrorKindOf("thetaxy_block"), nullptr);
  EXPECT_EQ(ErrorKindOf("luck_of_block"), nullptr);
}

TEST(Coverage, WhatIsNeededAndNothingElseIsEnough) {
  for (const auto& [name, step] : Steps()) {
    EXPECT_THAT(FlawsOfCoverage(Covered(step)), IsEmpty()) << name;
  }
}

TEST(Coverage, EachKindThatIsLeftOutIsMissed) {
  for (const auto& [name, step] : Steps()) {
    const PlannedStep covered = Covered(step);
    for (std::size_t i = 0; i < covered.certificate.preconditions.size(); ++i) {
      PlannedStep lacking = covered;
      auto& claims = lacking.certificate.preconditions;
      const std::string condition(claims[i].condition.name());
      claims.erase(claims.begin() + static_cast<int>(i));
      EXPECT_THAT(FlawsOfCoverage(lacking), ElementsAre(HasSubstr("covers no '" + condition + "'")))
          << name;
    }
  }
}

// A kind of precondition may be missing only for a reason of its own: the paper does not have it,
// or neighbours are far away.
TEST(Coverage, OnlyTheKindsOwnReasonsExcuse) {
  for (const auto& [name, step] : Steps()) {
    for (const Condition kind : ConditionsNeeded(step)) {
      for (const std::string reason :
           {"", "it is not needed", kNotPublished.data(), "no other part is near enough to be met",
            "it is not proved, and the plan names the step among what "
            "is not covered"}) {
        PlannedStep lacking = Covered(step);
        std::erase_if(lacking.certificate.preconditions,
                      [&](const auto& claim) { return claim.condition == kind; });
        lacking.certificate.not_needed = {{kind, reason}};
        const bool excuses = (reason == kNotPublished && !kind->is_published()) ||
                             (!reason.empty() && reason == kind->may_lack);
        EXPECT_EQ(FlawsOfCoverage(lacking).empty(), excuses)
            << name << ", " << kind->name << ": " << reason;
      }
    }
  }
}

TEST(Coverage, WhatIsClaimedAndExcusedOrOfAnotherActionIsTold) {
  PlannedStep pickup = Covered(Steps().at("pickup"));
  pickup.certificate.not_needed = {
      {condition::kHandClear, "no other part is near enough to be met"}};
  EXPECT_THAT(FlawsOfCoverage(pickup), ElementsAre(HasSubstr("and says that")));
  pickup = Covered(Steps().at("pickup"));
  pickup.certificate.preconditions.push_back(
      Covered(Steps().at("assemble")).certificate.preconditions.front());
  pickup.certificate.preconditions.back().condition = condition::kEntry;
  EXPECT_THAT(FlawsOfCoverage(pickup), ElementsAre("'entry' is no condition of such a step"));
}

// The checker refuses a mating whose certificate has no preconditions.
TEST(Coverage, TheCheckerRefusesAnEmptyCertificate) {
  const domain::Problem problem = PegAndBlock(BlockOnEnd());
  Plan plan = FourSteps(problem);
  EXPECT_THAT(Check(problem, plan, 1).flaws, IsEmpty()) << "made without regard to uncertainty";
  for (PlannedStep& step : plan.steps) step = Covered(std::move(step));
  EXPECT_THAT(Check(problem, plan, 1).flaws, IsEmpty());
  plan.steps[3].certificate = {};
  const std::vector<Flaw> flaws = Check(problem, plan, 1).flaws;
  for (const char* condition : {"entry", "slide-in", "tilt", "seat"}) {
    EXPECT_THAT(flaws, Contains(Field(&Flaw::what, HasSubstr(condition))));
  }
}

TEST(Circumstance, IsToldByTheWordsAtTheEndOfTheMeaning) {
  using enum Circumstance;
  for (const Circumstance circumstance : {kUsual, kWayHome, kYieldingWrist}) {
    const std::string meaning = "the arm stays clear" + std::string(WordsOf(circumstance));
    EXPECT_EQ(CircumstanceOf(meaning), circumstance) << meaning;
  }
  EXPECT_EQ(CircumstanceOf("on the way home, the arm stays clear"), kUsual);
  EXPECT_EQ(CircumstanceOf(""), kUsual);
}

// The schema requires the same kinds as the table of kinds.
TEST(PlanSchema, RequiresWhatTheTableRequires) {
  std::ifstream file(ASSAY_SOURCE_DIR "/planner/plan/plan_files/plan.schema.json");
  const Json definitions = Json::parse(file)["definitions"];
  std::vector<std::string> names;
  std::vector<std::string> reasons = {std::string(kNotPublished)};
  for (const ConditionKind* kind : KnownConditions()) {
    names.emplace_back(kind->name);
    const std::string reason(kind->may_lack);
    if (!reason.empty() && std::ranges::count(reasons, reason) == 0) reasons.push_back(reason);
  }
  EXPECT_EQ(definitions["condition"]["enum"], Json(names));
  const Json excuses = definitions["certificate"]["properties"]["covers"]["additionalProperties"]
                                  ["oneOf"][1]["enum"];
  EXPECT_THAT(excuses.get<std::vector<std::string>>(), testing::UnorderedElementsAreArray(reasons));

  const auto required = [](const Json& option) {
    return option["properties"]["certificate"]["properties"]["covers"]["required"];
  };
  for (const Json& option : definitions["handling"]["oneOf"]) {
    const std::string name = option["properties"]["name"]["const"];
    EXPECT_EQ(required(option), Json(NamesNeeded(Steps().at(name)))) << name;
  }
  const Json& assembling = definitions["assembling"]["oneOf"];
  EXPECT_EQ(required(assembling[0]), Json(NamesNeeded(Steps().at("assemble"))));
  EXPECT_EQ(required(assembling[1]), Json(NamesNeeded(Steps().at("felt in"))));
}

}  // namespace
}  // namespace assay::plan::coverage_test
