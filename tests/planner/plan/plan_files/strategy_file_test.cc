#include "planner/plan/plan_files/strategy_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "planner/base/random.h"
#include "planner/plan/certificates/condition_table.h"
#include "planner/plan/checker/checker.h"
#include "planner/plan/plan_files/plan_file.h"
#include "tests/oracle/json_schema.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/plan/peg_and_block.h"

namespace assay::plan::strategy_file_test {
namespace {

using Json = nlohmann::ordered_json;
using geometry::Vector3;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint64_t kSeed = 23;

Strategy SomeStrategy(RandomStream& random, double size) {
  const auto vector = [&] {
    return Vector3(random.Uniform(0, size), random.Uniform(0, size), random.Uniform(0, size));
  };
  Strategy strategy{.X_HeldTip = oracle::RandomPose(random, size),
                    .X_FixedStart = oracle::RandomPose(random, size),
                    .contacts = {{"vertex 3 on face 1", vector().normalized(), vector()},
                                 {"edge 2 on \"edge 5\"", Vector3::UnitZ(), -vector()}},
                    .motions = {}};
  strategy.motions = {
      {.kept = {},
       .X_FixedTip = oracle::RandomPose(random, size),
       .until = 1,
       .beyond = random.Uniform(0, 2),
       .slides = false,
       .unwanted =
           {{.contact = 0,
             .is_loss = false,
             .scale = 1.25,
             .gap = random.Uniform(-size, size),
             .separation = random.Uniform()},
            {.contact = 1, .is_loss = true, .scale = 3, .likely = TipError{vector(), -vector()}}}},
      {.kept = {1, 0},
       .X_FixedTip = oracle::RandomPose(random, size),
       .until = {},
       .beyond = 0,
       .slides = true}};
  strategy.friction = random.Uniform(0, 1);
  strategy.length = random.Uniform(0.1, 1) * size;
  strategy.certificate = {.absorbs = {condition::kEntry, condition::kTilt},
                          .d = vector(),
                          .w = 0.1 / size * vector(),
                          .velocity = 0.002,
                          .friction = 1,
                          .absorbed = random.Uniform(1, 2)};
  return strategy;
}

Strategy SomeStrategy() {
  RandomStream random(kSeed, "strategy");
  return SomeStrategy(random, 1);
}

const domain::Problem& FigureFourteen() {
  static const domain::Problem problem = PegAndBlock(BlockOnEnd());
  return problem;
}

PlanResult WithStrategy() {
  PlanResult result = {.outcome = Outcome::kFound,
                       .plan = FourSteps(FigureFourteen()),
                       .conflict = {},
                       .counters = {}};
  result.plan.steps[3].strategy = SomeStrategy();
  return result;
}

std::string ErrorOf(const Json& strategy) {
  try {
    ReadStrategy(Document::Parse(strategy.dump(2), "plan.json").root());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

template <class Change>
std::string ErrorAfter(const Change& change) {
  Json json = ToJson(SomeStrategy());
  change(json);
  return ErrorOf(json);
}

TEST(StrategyFile, ReadsBackToTheSameBytes) {
  RandomStream random(kSeed, "round trips");
  for (const double size : {1e-9, 1.0, 1e9}) {
    for (int i = 0; i < 20; ++i) {
      const std::string text = ToJson(SomeStrategy(random, size)).dump();
      EXPECT_EQ(ToJson(ReadStrategy(Document::Parse(text, "plan.json").root())).dump(), text);
    }
  }
}

TEST(StrategyFile, APlanCarriesIt) {
  const Json json = ToJson(WithStrategy(), FigureFourteen(), "s.yaml");
  EXPECT_FALSE(json["actions"][0].contains("strategy"));
  const PlanResult read = ReadPlan(Document::Parse(json.dump(), "plan.json"), FigureFourteen());
  EXPECT_EQ(ToJson(read, FigureFourteen(), "s.yaml").dump(), json.dump());
  ASSERT_TRUE(read.plan.steps[3].strategy);
  EXPECT_EQ(read.plan.steps[3].strategy->motions[0].until, 1);
  EXPECT_TRUE(read.plan.steps[3].strategy->motions[0].unwanted[1].is_loss);
  EXPECT_EQ(read.plan.steps[3].strategy->friction, SomeStrategy().friction);
}

TEST(StrategyFile, TheSchemaKnowsIt) {
  std::ifstream file(ASSAY_SOURCE_DIR "/planner/plan/plan_files/plan.schema.json");
  const oracle::JsonSchema schema(nlohmann::json::parse(file));
  Json json = ToJson(WithStrategy(), FigureFourteen(), "s.yaml");
  EXPECT_THAT(schema.Errors(json), IsEmpty());
  for (const char* field : {"friction", "length", "certificate"}) {
    Json less = json;
    less["actions"][3]["strategy"].erase(field);
    EXPECT_FALSE(schema.Errors(less).empty()) << field;
  }
  for (const char* field : {"contact", "is", "scale", "gap", "separation"}) {
    Json less = json;
    less["actions"][3]["strategy"]["motions"][0]["unwanted"][0].erase(field);
    EXPECT_FALSE(schema.Errors(less).empty()) << field;
  }
  json["actions"][0]["strategy"] = json["actions"][3]["strategy"];
  EXPECT_FALSE(schema.Errors(json).empty());
}

TEST(StrategyFile, OnlyAssembleHasOne) {
  Json json = ToJson(WithStrategy(), FigureFourteen(), "s.yaml");
  json["actions"][0]["strategy"] = json["actions"][3]["strategy"];
  try {
    ReadPlan(Document::Parse(json.dump(2), "plan.json"), FigureFourteen());
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a strategy of pickup"));
    EXPECT_THAT(error.what(), HasSubstr("plan.json:"));
  }
}

TEST(StrategyFile, WhatDoesNotFitIsRefusedAtItsPlace) {
  EXPECT_THAT(ErrorAfter([](Json& j) { j["motions"][0]["until"] = 2; }),
              testing::AllOf(HasSubstr("plan.json:"), HasSubstr("from 0 to 1")));
  EXPECT_THAT(ErrorAfter([](Json& j) { j["motions"][1]["kept"][0] = -1; }),
              HasSubstr("from 0 to 1"));
  EXPECT_THAT(ErrorAfter([](Json& j) {
                j["contacts"][0]["normal"] = {0, 0, 2};
              }),
              HasSubstr("a normal of length 2"));
  EXPECT_THAT(ErrorAfter([](Json& j) { j["certificate"]["d"][1] = -0.001; }),
              HasSubstr("-0.001 m is out of range; allowed: 0 m or more"));
  EXPECT_THAT(ErrorAfter([](Json& j) { j["motions"] = Json::array(); }),
              HasSubstr("without motions"));
  EXPECT_THAT(ErrorAfter([](Json& j) { j["motions"][0]["beyond"] = -1; }),
              HasSubstr(" is out of range; allowed: 0 or more"));
  EXPECT_THAT(ErrorAfter([](Json& j) { j["motions"][0]["unwanted"][0]["is"] = "mad"; }),
              HasSubstr("'made'"));
  const auto of_unwanted = [](const char* field, const Json& value) {
    return ErrorAfter([&](Json& j) { j["motions"][0]["unwanted"][0][field] = value; });
  };
  EXPECT_THAT(of_unwanted("contact", 2), HasSubstr("from 0 to 1"));
  EXPECT_THAT(of_unwanted("contact", "vertex 3 on face 1"), HasSubstr("plan.json:"));
  EXPECT_THAT(of_unwanted("scale", -1), HasSubstr(" is out of range; allowed: 0 or more"));
  EXPECT_THAT(of_unwanted("separation", 1.5), HasSubstr("1.5 is above 1"));
  EXPECT_THAT(of_unwanted("separation", -0.5), HasSubstr(" is out of range; allowed: 0 or more"));
  EXPECT_THAT(ErrorAfter([](Json& j) { j["motions"][0]["unwanted"][0].erase("gap"); }),
              HasSubstr("gap"));
  EXPECT_THAT(ErrorAfter([](Json& j) { j["friction"] = -0.1; }),
              HasSubstr(" is out of range; allowed: 0 or more"));
  EXPECT_THAT(ErrorAfter([](Json& j) { j["length"] = 0; }), HasSubstr("more than 0"));
  EXPECT_THAT(ErrorAfter([](Json& j) { j.erase("friction"); }), HasSubstr("friction"));
  EXPECT_THAT(ErrorAfter([](Json& j) {
                j["X_HeldTip"][0] = {1, 1, 0};
              }),
              HasSubstr("not the axes of a frame"));
  EXPECT_THAT(ErrorAfter([](Json& j) { j["remark"] = ""; }), HasSubstr("remark"));
}

// --- Strategies that were made by a program.

std::vector<std::string> FlawsAfter(const std::function<void(Strategy&)>& change) {
  Strategy strategy = SomeStrategy();
  change(strategy);
  return FlawsOfForm(strategy);
}

TEST(Strategy, FlawsOfFormAreTold) {
  EXPECT_THAT(FlawsAfter([](Strategy&) {}), IsEmpty());
  const auto expect = [](const std::function<void(Strategy&)>& change, const char* words) {
    EXPECT_THAT(FlawsAfter(change), Contains(HasSubstr(words)));
  };
  expect([](Strategy& s) { s.motions.clear(); }, "no motions");
  expect([](Strategy& s) { s.motions[0].until = 7; }, "motion 1: no contact 7");
  expect([](Strategy& s) { s.motions[1].kept = {-1}; }, "motion 2: no contact -1");
  expect([](Strategy& s) { s.motions[1].until = 1; }, "that it keeps");
  expect([](Strategy& s) { s.contacts[0].normal *= 2; }, "not of unit length");
  expect([](Strategy& s) { s.motions[0].unwanted[0].contact = 5; }, "motion 1: no contact 5");
  expect([](Strategy& s) { s.motions[0].unwanted[0].is_loss = true; }, "not there to be lost");
  expect([](Strategy& s) { s.motions[0].unwanted[1].is_loss = false; }, "wanted and unwanted");
  expect([](Strategy& s) { s.motions[0].unwanted[0].separation = 1.1; }, "separation of contact 0");
  expect([](Strategy& s) { s.motions[0].unwanted[0].gap = std::nan(""); }, "gap of contact 0");
  expect([](Strategy& s) { s.friction = -1; }, "friction is below 0");
  expect([](Strategy& s) { s.length = 0; }, "length is not above 0");
  expect([](Strategy& s) { s.X_FixedStart.linear() *= 1.1; }, "X_FixedStart is no frame");
  expect([](Strategy& s) { s.certificate.absorbed = 0.9; }, "absorbs 0.9 times");
  expect([](Strategy& s) { s.friction = 1.5; }, "friction of 1 could hold");
  expect([](Strategy& s) { s.certificate.w = Vector3(0, 2, 0); }, "more than a right angle");
  expect([](Strategy& s) { s.certificate.d.x() = std::numeric_limits<double>::quiet_NaN(); },
         "half width");
}

TEST(Strategy, StatesAreOfWhatIsKeptAndWaitedFor) {
  const StrategyMotion motion{.kept = {4, 2}, .X_FixedTip = {}, .until = 7};
  EXPECT_EQ(ContactsAfter(motion), (std::vector<int>{4, 2, 7}));
  EXPECT_EQ(ContactsInError(motion, {.contact = 5}), (std::vector<int>{4, 2, 5}));
  EXPECT_EQ(ContactsInError(motion, {.contact = 2, .is_loss = true}), (std::vector<int>{4, 7}));
  EXPECT_EQ(ContactsInError(motion, {.contact = 7, .is_loss = true}), (std::vector<int>{4, 2}));
  EXPECT_EQ(ContactsAt(SomeStrategy(), {1})[0].name, "edge 2 on \"edge 5\"");
}

TEST(Strategy, AbsorbsOnlyWhatItSaysAndIfItAbsorbsAllErrors) {
  std::optional<Strategy> strategy = SomeStrategy();
  EXPECT_TRUE(Absorbs(strategy, condition::kTilt));
  EXPECT_FALSE(Absorbs(strategy, condition::kHandClear));
  strategy->certificate.absorbed = 0.99;
  EXPECT_FALSE(Absorbs(strategy, condition::kTilt));
  EXPECT_FALSE(Absorbs(std::nullopt, condition::kTilt));
}

TEST(Strategy, TheCheckerLooksAtIt) {
  Plan plan = WithStrategy().plan;
  EXPECT_THAT(Check(FigureFourteen(), plan, 2).flaws, IsEmpty());
  plan.steps[3].strategy->certificate.absorbed = 0;
  plan.steps[0].strategy = SomeStrategy();
  const std::vector<Flaw> flaws = Check(FigureFourteen(), plan, 2).flaws;
  EXPECT_THAT(flaws, Contains(Field(&Flaw::what, HasSubstr("only assemble"))));
  EXPECT_THAT(flaws, Contains(Field(&Flaw::what, HasSubstr("absorbs 0 times"))));
}

}  // namespace
}  // namespace assay::plan::strategy_file_test
