#include "planner/plan/plan_files/plan_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <tuple>

#include "planner/base/random.h"
#include "planner/plan/certificates/coverage.h"
#include "planner/plan/checker/checker.h"
#include "tests/oracle/json_schema.h"
#include "tests/oracle/random_pose.h"
#include "tests/planner/plan/actions.h"
#include "tests/planner/plan/peg_and_block.h"

namespace assay::plan::plan_file_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::AllOf;
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

Certificate SomeCertificate(double number) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const ErrorVariable dx = {"dx_block", {-number, 3 * number}, domain::Dimension::kLength};
  return {
      .variables = {dx, {"theta_block", {-kInfinity, kInfinity}, domain::Dimension::kAngle}},
      .shared = {"sin(theta_block)", "dx_block * #0"},
      .before = {{.part = kBlock,
                  .in_hand = false,
                  .x = dx.range,
                  .y = {-1e-300, 5e-324},
                  .z = {-kInfinity, 0.1},
                  .theta = {}}},
      .preconditions = {{.condition = condition::kBetweenFingers,
                         .meaning = "contact 2 lies on the inner side of finger 1",
                         .expression = "1.5 + #1",
                         .relation = Relation::kGreater,
                         .limit = number,
                         .bound = -kInfinity,
                         .margin = -kInfinity,
                         .gap = kInfinity,
                         .method = "term-wise",
                         .worst = {{"dx_block", number}}},
                        {.condition = condition::kPadContact,
                         .meaning = "a \"quoted\" meaning",
                         .expression = "dx_block",
                         .relation = Relation::kLess,
                         .limit = 1,
                         .bound = number / 3,
                         .margin = 1 - number / 3,
                         .gap = 0,
                         .method = ""}},
      .not_needed = {{condition::kFingerClear, std::string(kNotPublished)},
                     {condition::kFingertip, std::string(kNotPublished)},
                     {condition::kUpright, std::string(kNotPublished)},
                     {condition::kPushedClear, std::string(kNotPublished)},
                     {condition::kHolding, std::string(kNotPublished)},
                     {condition::kHandClear, "no other part is near enough to be met"},
                     {condition::kReach, std::string(kNotPublished)},
                     {condition::kWayClear, std::string(kNotPublished)}},
      .after = {{.part = kPeg, .in_hand = true, .x = {}, .y = {}, .z = {}, .theta = {0.1, 0.2}}},
      .resolutions = {{"sensing", {StepId(4), StepId(5)}, "between fingers: -inf > 0"},
                      {"verification", {}, ""}}};
}

// Returns a made-up plan of the second phase: the block is looked at and squeezed before it is
// taken.
PlanResult Augmented() {
  PlanResult result = Planned();
  Plan& plan = result.plan;
  const Place place = PlaceNow(FigureFourteen(), kBlock);
  for (PlannedStep& step : plan.steps) step.executed += 2;
  plan.steps.push_back({"action_5", Sense(kBlock, "overhead-camera", place), 5, 1});
  plan.steps.push_back({"action_6", Squeeze(kBlock, BlockHold(), place), 6, 2});
  plan.ordering.emplace_back(StepId(4), StepId(5));
  plan.ordering.emplace_back(StepId(5), StepId(0));
  plan.steps[0].certificate = SomeCertificate(0.1);
  plan.steps[5].certificate = SomeCertificate(0.2);
  plan.verifications = {
      {.step = StepId(0),
       .name = "gripper-opening",
       .quantity = domain::MeasuredQuantity::kGripperOpening,
       .expected = 0.0762,
       .tolerance = 0.001,
       .below = "error1",
       .above = "error2"},
      {.step = StepId(1),
       .name = "landed",
       .quantity = domain::MeasuredQuantity::kToolHeight,
       .expected = 0.1 / 3,
       .tolerance = 0.002,
       .below = "",
       .above = "error3"},
  };
  plan.recoveries = {
      {.step = StepId(0),
       .error = "error1",
       .strategy = domain::RecoveryStrategy::kGropingSearch,
       .radius = 0.01,
       .pitch = 0.003},
      {.step = StepId(0), .error = "error2", .strategy = domain::RecoveryStrategy::kCallOperator},
      {.step = StepId(1), .error = "error3", .strategy = domain::RecoveryStrategy::kRetry}};
  plan.errors = 2;
  return result;
}

PlanResult NoPlan() {
  PlanResult result;
  result.outcome = Outcome::kNone;
  result.plan.problem = FigureFourteen().name;
  result.conflict = {{.text = "peg: every grasp hides feature 7"}, {.text = "a \\ and a \n"}};
  result.hypotheses = {"grasps: 3 of peg"};
  result.near_misses = {{.text = "the tool would lean 3 deg more"}};
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
  std::ifstream file(ASSAY_SOURCE_DIR "/planner/plan/plan_files/plan.schema.json");
  return oracle::JsonSchema(nlohmann::json::parse(file));
}

TEST(PlanSchema, AcceptsWhatIsWritten) {
  const oracle::JsonSchema schema = Schema();
  for (const PlanResult& result : {Planned(), Augmented(), NoPlan(), OutOfBudget()}) {
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
  expect_refused([](Json& json) { json["format"] = "assay-plan/1"; });
  expect_refused([](Json& json) { json["outcome"] = "found"; });
  expect_refused([](Json& json) { json["outcome"] = "none"; });
  expect_refused([](Json& json) { json["conflict"] = Json::array(); });
  expect_refused([](Json& json) {
    json = ToJson(NoPlan());
    json["conflict"] = Json::array();
  });
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

TEST(PlanSchema, RefusesAugmentationsThatTheReaderRefuses) {
  const oracle::JsonSchema schema = Schema();
  const auto expect_refused = [&](const auto& change) {
    Json json = ToJson(Augmented());
    change(json);
    EXPECT_FALSE(schema.Errors(json).empty()) << json.dump(2);
    EXPECT_NE(ErrorOf(json), "no error") << json.dump(2);
  };
  const auto expect_certificate_refused = [&](const auto& change) {
    expect_refused([&](Json& json) { change(json["actions"][0]["certificate"]); });
  };
  expect_refused([](Json& json) { json["errors"] = -1; });
  expect_refused([](Json& json) { json["errors"] = "none"; });
  expect_refused([](Json& json) { json["actions"][4]["hold"] = json["actions"][5]["hold"]; });
  expect_refused([](Json& json) { json["actions"][4]["arguments"].erase("sensor"); });
  expect_refused([](Json& json) { json["actions"][4]["arguments"]["grasp"] = "BG1"; });
  expect_refused([](Json& json) { json["actions"][5].erase("hold"); });
  expect_refused([](Json& json) { json["actions"][5]["name"] = "sense"; });
  expect_refused([](Json& json) { json["verifications"][0]["measures"] = "weight"; });
  expect_refused([](Json& json) { json["verifications"][0]["tolerance"] = -0.1; });
  expect_refused([](Json& json) { json["verifications"][0]["below"] = ""; });
  expect_refused([](Json& json) { json["verifications"][0].erase("expected"); });
  expect_refused([](Json& json) { json["recoveries"][0].erase("pitch"); });
  expect_refused([](Json& json) { json["recoveries"][0]["strategy"] = "hope"; });
  expect_refused([](Json& json) { json["recoveries"][1]["radius"] = 1; });
  expect_certificate_refused([](Json& json) { json.erase("after"); });
  expect_certificate_refused([](Json& json) { json["remark"] = ""; });
  expect_certificate_refused([](Json& json) { json["variables"][0]["range"] = {1, "large"}; });
  expect_certificate_refused([](Json& json) { json["variables"][0]["range"] = {1, 2, 3}; });
  expect_certificate_refused([](Json& json) { json["before"][0].erase("in_hand"); });
  expect_certificate_refused([](Json& json) { json["preconditions"][0]["relation"] = "<="; });
  expect_certificate_refused([](Json& json) { json["preconditions"][0].erase("condition"); });
  expect_certificate_refused([](Json& json) { json["preconditions"][1]["gap"] = nullptr; });
  expect_certificate_refused([](Json& json) { json["resolutions"][0].erase("steps"); });
  expect_certificate_refused([](Json& json) { json["preconditions"][0]["condition"] = "luck"; });
  expect_certificate_refused([](Json& json) { json.erase("covers"); });
  expect_certificate_refused([](Json& json) { json["covers"].erase("pad contact"); });
  expect_certificate_refused([](Json& json) { json["covers"]["pad contact"] = "proved"; });
}

TEST(PlanFile, AugmentationsThatFitNoStepOrPartAreRefused) {
  const auto error_after = [](const auto& change) {
    Json json = ToJson(Augmented());
    change(json);
    return ErrorOf(json);
  };
  const auto certificate_error_after = [&](const auto& change) {
    return error_after([&](Json& json) { change(json["actions"][0]["certificate"]); });
  };
  EXPECT_THAT(error_after([](Json& j) { j["verifications"][0]["step"] = "action_9"; }),
              HasSubstr("unknown name 'action_9'"));
  EXPECT_THAT(error_after([](Json& j) { j["recoveries"][0]["step"] = "action_9"; }),
              HasSubstr("unknown name 'action_9'"));
  EXPECT_THAT(error_after([](Json& j) { j["actions"][4]["arguments"]["sensor"] = "overhead-cam"; }),
              HasSubstr("unknown name 'overhead-cam'"));
  EXPECT_THAT(error_after([](Json& j) { j["errors"] = 7; }), HasSubstr("from 0 to 6"));
  EXPECT_THAT(certificate_error_after([](Json& j) { j["before"][0]["part"] = "blok"; }),
              HasSubstr("did you mean 'block'"));
  EXPECT_THAT(certificate_error_after([](Json& j) {
                j["before"][0]["x"] = {2, 1};
              }),
              HasSubstr("the range goes down"));
  EXPECT_THAT(certificate_error_after([](Json& j) { j["covers"]["pad contact"] = 2; }),
              HasSubstr("'2' of 'pad contact'; allowed: 1, as many as there are"));
  EXPECT_THAT(certificate_error_after([](Json& j) { j["covers"]["luck"] = 1; }),
              HasSubstr("unknown name 'luck'"));
  EXPECT_THAT(certificate_error_after([](Json& j) { j["variables"][0]["name"] = "luck_block"; }),
              HasSubstr("'luck_block' names no error of a part or of the hand"));
  EXPECT_THAT(certificate_error_after([](Json& j) {
                j["before"][0]["x"] = {"inf", 1};
              }),
              HasSubstr("the range goes down"));
  EXPECT_THAT(
      certificate_error_after([](Json& j) { j["resolutions"][0]["steps"][0] = "action_0"; }),
      HasSubstr("unknown name 'action_0'"));
}

TEST(PlanFile, CertificatesAreWrittenOnlyWhereThereAreAny) {
  const Json json = ToJson(Augmented());
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(json["actions"][i].contains("certificate"), i == 0 || i == 5) << i;
  }
  const Json& certificate = json["actions"][0]["certificate"];
  EXPECT_EQ(certificate["variables"][1]["range"], Json::parse(R"(["-inf", "inf"])"));
  EXPECT_EQ(certificate["before"][0]["part"], "block");
  EXPECT_EQ(certificate["preconditions"][0]["relation"], ">");
  EXPECT_EQ(certificate["covers"]["pad contact"], 1);
  EXPECT_EQ(certificate["covers"]["hand clear"], "no other part is near enough to be met");
  EXPECT_EQ(certificate["resolutions"][0]["steps"], Json::parse(R"(["action_5", "action_6"])"));
  EXPECT_FALSE(json["verifications"][1].contains("below"));
  EXPECT_FALSE(json["recoveries"][1].contains("radius"));
}

TEST(PlanFile, CertificatesReadBackAsTheyWere) {
  RandomStream random(kSeed, "certificates");
  for (int trial = 0; trial < 50; ++trial) {
    PlanResult result = Augmented();
    const double scale = trial % 2 == 0 ? 1e-9 : 1e9;
    result.plan.steps[0].certificate = SomeCertificate(random.Uniform(0, scale));
    result.plan.steps[4].certificate = SomeCertificate(random.Uniform(0, 1));
    const Plan read = Read(ToJson(result)).plan;
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_EQ(read.steps[i].certificate, result.plan.steps[i].certificate) << "seed " << kSeed;
    }
  }
}

TEST(PlanFile, SensingSqueezingVerificationsAndRecoveriesReadBack) {
  const Plan plan = Augmented().plan;
  const Plan read = Read(ToJson(Augmented())).plan;
  const Action& sense = read.steps[4].action;
  EXPECT_EQ(sense.part, kBlock);
  EXPECT_EQ(sense.sensor, "overhead-camera");
  EXPECT_EQ(sense.place.position, "initial");
  EXPECT_EQ(sense.place.X_WorldPart.matrix(), FigureFourteen().part(kBlock).X_WorldPart.matrix());
  const Action& squeeze = read.steps[5].action;
  EXPECT_EQ(squeeze.part, kBlock);
  EXPECT_EQ(squeeze.hold.X_PartTool.matrix(), BlockHold().X_PartTool.matrix());
  ASSERT_EQ(read.verifications.size(), plan.verifications.size());
  for (std::size_t i = 0; i < plan.verifications.size(); ++i) {
    const Verification& a = plan.verifications[i];
    const Verification& b = read.verifications[i];
    EXPECT_EQ(std::tie(a.step, a.name, a.quantity, a.expected, a.tolerance, a.below, a.above),
              std::tie(b.step, b.name, b.quantity, b.expected, b.tolerance, b.below, b.above));
  }
  ASSERT_EQ(read.recoveries.size(), plan.recoveries.size());
  for (std::size_t i = 0; i < plan.recoveries.size(); ++i) {
    const Recovery& a = plan.recoveries[i];
    const Recovery& b = read.recoveries[i];
    EXPECT_EQ(std::tie(a.step, a.error, a.strategy, a.radius, a.pitch),
              std::tie(b.step, b.error, b.strategy, b.radius, b.pitch));
  }
  EXPECT_EQ(read.errors, 2);
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
  const Pose& X = result.plan.steps[1].action.place.X_WorldPart;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      EXPECT_EQ(pose[column][row].get<double>(), X.matrix()(row, column));
    }
  }
}

TEST(PlanFile, ReadsBackToTheSameBytes) {
  for (const PlanResult& result : {Planned(), Augmented(), NoPlan(), OutOfBudget()}) {
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
    Action& pickup = result.plan.steps[0].action;
    pickup.place.X_WorldPart = oracle::RandomPose(random, trial % 2 == 0 ? 1e-12 : 1e12);
    pickup.hold.width = random.Uniform(0, 1e-3);
    const PlanResult read = Read(ToJson(result));
    const Action& again = read.plan.steps[0].action;
    EXPECT_EQ(again.place.X_WorldPart.matrix(), pickup.place.X_WorldPart.matrix())
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
  EXPECT_THAT(error_after([](Json& j) { j["actions"][3]["inserted"] = 5; }),
              AllOf(HasSubstr("order of insertion"), HasSubstr("allowed: 4")));
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

// Replaces, doubles or removes a character or a piece of the text.
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
  const std::vector<std::string> texts = {ToJson(Planned()).dump(), ToJson(Augmented()).dump()};
  int read = 0, refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    const std::string mutated = Mutated(texts[static_cast<std::size_t>(i % 2)], random);
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
}  // namespace assay::plan::plan_file_test
