#include "planner/plan/data/condition_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "planner/plan/check/checker.h"
#include "tests/planner/plan/peg_and_block.h"

namespace assay::plan::condition_kind_test {
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
    all["pickup"].action = plan::Action{.kind = &domain::kPickup};
    all["putdown"].action = plan::Action{.kind = &domain::kPutdown};
    all["assemble"].action = plan::Action{.kind = &domain::kAssemble};
    all["felt in"].action = plan::Action{.kind = &domain::kAssemble};
    all["felt in"].strategy = Strategy{};
    all["sense"].action = plan::Action{.kind = &domain::kSense};
    all["squeeze"].action = plan::Action{.kind = &domain::kSqueeze};
    return all;
  }();
  return steps;
}

std::vector<const ConditionKind*> KindsNeeded(const PlannedStep& step) {
  return plan::KindsNeeded(step.action, step.strategy ? &*step.strategy : nullptr);
}

std::vector<std::string> NamesNeeded(const PlannedStep& step) {
  std::vector<std::string> names;
  for (const ConditionKind* kind : KindsNeeded(step)) names.emplace_back(kind->name);
  return names;
}

// Adds one precondition of each kind that the step needs.
PlannedStep Covered(PlannedStep step) {
  for (const std::string& name : NamesNeeded(step)) {
    CertifiedPrecondition claim;
    claim.condition = name;
    step.certificate.preconditions.push_back(claim);
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
                          "fixed stands", "fixed stays", "standing", "pressed", "holding",
                          "hand clear", "reach", "way clear"));
  EXPECT_THAT(NamesNeeded(Steps().at("felt in")),
              ElementsAre("fingertip", "entry", "slide-in", "tilt", "seat", "passing clear",
                          "fixed stands", "fixed stays", "tip shift", "tip turn", "standing",
                          "pressed", "holding", "hand clear", "reach", "way clear"));
}

TEST(ConditionKind, NamesAreUnique) {
  for (const ConditionKind& kind : ConditionKinds()) {
    EXPECT_EQ(FindConditionKind(kind.name), &kind);
    EXPECT_EQ(QuantityOf(kind.name), kind.quantity);
  }
  EXPECT_EQ(FindConditionKind("luck"), nullptr);
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
      const std::string condition = claims[i].condition;
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
    for (const ConditionKind* kind : KindsNeeded(step)) {
      for (const std::string reason :
           {"", "it is not needed", kNotPublished.data(), "no other part is near enough to be met",
            "it is not proved, and the plan names the step among what "
            "is not covered"}) {
        PlannedStep lacking = Covered(step);
        std::erase_if(lacking.certificate.preconditions,
                      [&](const auto& claim) { return claim.condition == kind->name; });
        lacking.certificate.not_needed = {{std::string(kind->name), reason}};
        const bool excuses = (reason == kNotPublished && !kind->is_published) ||
                             (!reason.empty() && reason == kind->may_lack);
        EXPECT_EQ(FlawsOfCoverage(lacking).empty(), excuses)
            << name << ", " << kind->name << ": " << reason;
      }
    }
  }
}

TEST(Coverage, WhatIsClaimedAndExcusedOrOfAnotherActionIsTold) {
  PlannedStep pickup = Covered(Steps().at("pickup"));
  pickup.certificate.not_needed = {{"hand clear", "no other part is near enough to be met"}};
  EXPECT_THAT(FlawsOfCoverage(pickup), ElementsAre(HasSubstr("and says that")));
  pickup = Covered(Steps().at("pickup"));
  pickup.certificate.preconditions.push_back(
      Covered(Steps().at("assemble")).certificate.preconditions.front());
  pickup.certificate.preconditions.back().condition = "entry";
  EXPECT_THAT(FlawsOfCoverage(pickup), ElementsAre("'entry' is no condition of such a step"));
  pickup.certificate.preconditions.back().condition = "luck";
  EXPECT_THAT(FlawsOfCoverage(pickup), ElementsAre("'luck' is no condition of such a step"));
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

// The schema requires the same kinds as the table of kinds.
TEST(PlanSchema, RequiresWhatTheTableRequires) {
  std::ifstream file(ASSAY_SOURCE_DIR "/planner/plan/file/plan.schema.json");
  const Json definitions = Json::parse(file)["definitions"];
  std::vector<std::string> names;
  std::vector<std::string> reasons = {std::string(kNotPublished)};
  for (const ConditionKind& kind : ConditionKinds()) {
    names.emplace_back(kind.name);
    const std::string reason(kind.may_lack);
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
}  // namespace assay::plan::condition_kind_test
