#include "planner/plan/plan_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "planner/base/random.h"
#include "planner/plan/checker.h"
#include "tests/oracle/json_schema.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/plan/peg_and_block.h"

namespace assay::plan {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::uint64_t kSeed = 17;
constexpr const char* kScenario = "scenarios/a \"quoted\" path.yaml";

const domain::Problem& FigureFourteen() {
  static const domain::Problem problem = PegAndBlock(BlockOnEnd());
  return problem;
}

PlanResult Planned() {
  return {.outcome = Outcome::kFound,
          .plan = FourSteps(FigureFourteen()),
          .conflict = {},
          .counters = {{"nodes", 12}, {"revisions", 12345678901234}}};
}

PlanResult NoPlan() {
  PlanResult result;
  result.outcome = Outcome::kNone;
  result.plan.problem = FigureFourteen().name;
  result.conflict = {"peg: every grasp hides feature 7", "a \\ and a \n"};
  return result;
}

PlanResult OutOfBudget() {
  PlanResult result;
  result.plan.problem = FigureFourteen().name;
  return result;
}

Json ToJson(const PlanResult& result) { return ToJson(result, FigureFourteen(), kScenario); }

PlanResult Read(const std::string& text) {
  return ReadPlan(Document::Parse(text, "plan.json"), FigureFourteen());
}
PlanResult Read(const Json& json) { return Read(json.dump(2)); }

std::string ErrorOf(const Json& json) {
  try {
    Read(json);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

oracle::JsonSchema Schema() {
  std::ifstream file(ASSAY_SOURCE_DIR "/planner/plan/plan.schema.json");
  return oracle::JsonSchema(nlohmann::json::parse(file));
}

TEST(PlanSchema, AcceptsWhatIsWritten) {
  const oracle::JsonSchema schema = Schema();
  for (const PlanResult& result : {Planned(), NoPlan(), OutOfBudget()}) {
    EXPECT_THAT(schema.Errors(ToJson(result)), IsEmpty()) << ToJson(result).dump(2);
  }
}

TEST(PlanSchema, RefusesWhatTheReaderRefuses) {
  const oracle::JsonSchema schema = Schema();
  const auto expect_refused = [&](const auto& change) {
    Json json = ToJson(Planned());
    change(json);
    EXPECT_FALSE(schema.Errors(json).empty()) << json.dump(2);
    EXPECT_NE(ErrorOf(json), "no error") << json.dump(2);
  };
  expect_refused([](Json& json) { json.erase("format"); });
  expect_refused([](Json& json) { json["format"] = "assay-plan/2"; });
  expect_refused([](Json& json) { json["outcome"] = "found"; });
  expect_refused([](Json& json) { json["outcome"] = "none"; });
  expect_refused([](Json& json) { json["conflict"] = Json::array(); });
  expect_refused([](Json& json) { json["remark"] = "none"; });
  expect_refused([](Json& json) { json["counters"]["nodes"] = 1.5; });
  expect_refused([](Json& json) { json["ordering"][0].push_back("action_4"); });
  expect_refused([](Json& json) { json["verifications"].push_back("look"); });
  expect_refused([](Json& json) { json["actions"][0]["name"] = "assemble"; });
  expect_refused([](Json& json) { json["actions"][0]["executed"] = 0; });
  expect_refused([](Json& json) { json["actions"][0]["hold"]["width"] = -0.01; });
  expect_refused([](Json& json) { json["actions"][0]["hold"]["X_PartTool"].erase(3); });
  expect_refused([](Json& json) { json["actions"][1]["place"]["X_WorldPart"][2].push_back(0); });
  expect_refused([](Json& json) { json["actions"][3]["arguments"].erase("mating_vector"); });
}

TEST(PlanFile, SpeaksInTheWordsOfTheScenario) {
  const Json json = ToJson(Planned());
  EXPECT_EQ(json["outcome"], "planned");
  EXPECT_EQ(json["actions"][0]["name"], "pickup");
  EXPECT_EQ(json["actions"][0]["arguments"]["part"], "block");
  EXPECT_EQ(json["actions"][3]["arguments"]["features"], Json::parse("[[7, 8], [7, 8]]"));
  EXPECT_EQ(json["ordering"][0], Json::parse(R"(["action_1", "action_2"])"));
  EXPECT_FALSE(json.contains("conflict"));
  EXPECT_EQ(ToJson(NoPlan())["conflict"].size(), 2u);
  EXPECT_EQ(ToJson(OutOfBudget())["outcome"], "budget");
}

TEST(PlanFile, PoseIsWrittenAsColumns) {
  const PlanResult result = Planned();
  const Json pose = ToJson(result)["actions"][1]["place"]["X_WorldPart"];
  const Pose& X = std::get<Putdown>(result.plan.steps[1].action).to.X_WorldPart;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      EXPECT_EQ(pose[column][row].get<double>(), X.matrix()(row, column));
    }
  }
}

TEST(PlanFile, ReadsBackToTheSameBytes) {
  for (const PlanResult& result : {Planned(), NoPlan(), OutOfBudget()}) {
    for (const int indent : {-1, 0, 2}) {
      const std::string text = ToJson(result).dump(indent);
      EXPECT_EQ(ToJson(Read(text)).dump(indent), text);
      EXPECT_EQ(ScenarioOf(Document::Parse(text, "plan.json")), kScenario);
    }
  }
}

TEST(PlanFile, ReadsBackToTheSameDoubles) {
  RandomStream random(kSeed, "doubles");
  for (int trial = 0; trial < 50; ++trial) {
    PlanResult result = Planned();
    Pickup& pickup = std::get<Pickup>(result.plan.steps[0].action);
    pickup.from.X_WorldPart = oracle::RandomPose(random, trial % 2 == 0 ? 1e-12 : 1e12);
    pickup.hold.width = random.Uniform(0, 1e-3);
    const PlanResult read = Read(ToJson(result));
    const Pickup& again = std::get<Pickup>(read.plan.steps[0].action);
    EXPECT_EQ(again.from.X_WorldPart.matrix(), pickup.from.X_WorldPart.matrix())
        << "seed " << kSeed;
    EXPECT_EQ(again.hold.width, pickup.hold.width);
  }
}

TEST(PlanFile, ReadsTheSecondsThatAProgramAdds) {
  Json json = ToJson(Planned());
  json["seconds"] = 0.25;
  EXPECT_THAT(Schema().Errors(json), IsEmpty());
  EXPECT_EQ(ErrorOf(json), "no error");
}

TEST(PlanFile, WhatDoesNotFitTheProblemIsRefusedAtItsPlace) {
  const auto error_after = [](const auto& change) {
    Json json = ToJson(Planned());
    change(json);
    return ErrorOf(json);
  };
  EXPECT_THAT(error_after([](Json& j) { j["problem"] = "another"; }), HasSubstr("'another'"));
  EXPECT_THAT(error_after([](Json& j) { j["actions"][0]["arguments"]["part"] = "blok"; }),
              HasSubstr("did you mean 'block'"));
  EXPECT_THAT(error_after([](Json& j) { j["actions"][3]["arguments"]["held"] = "block"; }),
              HasSubstr("no such mating"));
  EXPECT_THAT(error_after([](Json& j) { j["actions"][3]["arguments"]["mating_vector"][0] = -0.1; }),
              HasSubstr("no such mating"));
  EXPECT_THAT(error_after([](Json& j) { j["actions"][1]["executed"] = 1; }),
              HasSubstr("two steps are executed at the same time"));
  EXPECT_THAT(error_after([](Json& j) { j["actions"][1]["executed"] = 5; }),
              HasSubstr("5 of 4 steps"));
  EXPECT_THAT(error_after([](Json& j) { j["actions"][1]["inserted"] = 1; }),
              HasSubstr("order of insertion"));
  EXPECT_THAT(error_after([](Json& j) { j["actions"][1]["id"] = "action_1"; }),
              HasSubstr("an id is given twice"));
  EXPECT_THAT(error_after([](Json& j) {
                j["ordering"].push_back({"action_4", "action_1"});
              }),
              HasSubstr("cyclic"));
  EXPECT_THAT(error_after([](Json& j) { j["ordering"][0][0] = "action_9"; }),
              HasSubstr("plan.json:"));
  EXPECT_THAT(error_after([](Json& j) { j["actions"][0]["hold"]["X_PartTool"][0][0] = 2; }),
              HasSubstr("not the axes of a frame"));
  EXPECT_THAT(ErrorOf(Json::parse("[1]")), HasSubstr("plan.json:"));
}

// A character, or a stretch of text, is replaced, doubled or left out.
std::string Mutated(std::string text, RandomStream& random) {
  static const std::string kCharacters = "0123456789-.eE\"[]{},: \n\tabcn\\#&*!|>%@`\x01\xff";
  for (int i = 1 + random.Index(3); i > 0; --i) {
    const std::size_t at = random.Index(static_cast<int>(text.size()));
    const std::size_t length = 1 + random.Index(random.Index(4) == 0 ? 60 : 3);
    switch (random.Index(3)) {
      case 0:
        text[at] = kCharacters[random.Index(static_cast<int>(kCharacters.size()))];
        break;
      case 1:
        text.insert(at, text.substr(at, length));
        break;
      case 2:
        text.erase(at, length);
        break;
    }
    if (text.empty()) text.push_back(kCharacters[0]);
  }
  return text;
}

TEST(PlanFile, MutationsAreReadOrRefusedAndNothingElse) {
  constexpr int kMutations = 2000;
  RandomStream random(kSeed, "mutations");
  const std::string text = ToJson(Planned()).dump();
  int read = 0, refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string mutated = Mutated(text, random);
    try {
      const PlanResult result = Read(mutated);
      if (++read % 5 == 0) Check(FigureFourteen(), result.plan, 2);
    } catch (const InputError&) {
      ++refused;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "seed " << kSeed << ": " << error.what() << " for " << mutated;
    }
  }
  EXPECT_EQ(read + refused, kMutations);
  EXPECT_GT(read, 20);
  EXPECT_GT(refused, kMutations / 2);
}

}  // namespace
}  // namespace assay::plan
