#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::check_test {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

const std::string kBlock = kTree / "models/parts/block/part.yaml";
const std::string kTable = kTree / "models/workcells/puma762-table/workcell.yaml";

TEST(Check, ScenarioHoldsWithItsClearances) {
  const Ended ended = Assay({"check", kTree / "scenarios/spar-fig15.yaml", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto report = ended.Json()["files"][0];
  EXPECT_THAT(report["parts"], SizeIs(2));
  EXPECT_THAT(report["parts"][0]["stable_poses"], SizeIs(6));
  EXPECT_GT(report["parts"][1]["reachable_at_start"], 0);
  ASSERT_THAT(report["clearances"], SizeIs(2));  // along both sides of the hole
  for (const auto& clearance : report["clearances"]) {
    EXPECT_NEAR(clearance["nominal"].get<double>(), 0.0005, 1e-9);
    EXPECT_NEAR(clearance["effective"], 0.0005, 0.05 * 0.0005);
  }
}

TEST(Check, EveryScenarioHolds) {
  std::vector<std::string> arguments = {"check", "--json"};
  for (const auto& entry : std::filesystem::directory_iterator(kTree / "scenarios")) {
    if (entry.path().extension() == ".yaml") arguments.push_back(entry.path());
  }
  const Ended ended = Assay(arguments);
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_EQ(ended.Json()["files"].size(), arguments.size() - 2);
}

// The sleeve is the held part here, and it has the hole.
TEST(Check, ClearancesAreMeasuredWhicheverPartHasTheHole) {
  const Ended ended = Assay({"check", kTwoLooks, "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto clearances = ended.Json()["files"][0]["clearances"];
  ASSERT_THAT(clearances, SizeIs(2));
  for (const auto& clearance : clearances) {
    EXPECT_EQ(clearance["held"], "sleeve");
    EXPECT_NEAR(clearance["effective"], clearance["nominal"],
                0.01 * clearance["nominal"].get<double>());
  }
}

TEST(Check, SaysWhyNoClearanceIsMeasured) {
  const Folder folder;
  const std::string scenario = folder.Write("stacked.yaml", R"(format: assay-scenario/1
workcell: puma762-table
parts:
  lower: {model: brick, pose: {stable: upright, at: [0.6, 0]}}
  upper: {model: brick}
initially:
  - assembled: {held: upper, fixed: lower, features: [[6], [5]], mating_vector: [0, 0, -0.02],
                pose: {columns: [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, 0.1016]]}}
goal:
  - located: {part: lower, stable: [upright]}
)");
  const Ended ended = Assay({"check", scenario, "--models", kTree / "models"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("no play of upper on lower: no shaft is in a hole there"));
}

// The part is wider than the gripper opens in every direction.
TEST(Check, TellsWhatNoGraspCanMove) {
  const Folder folder;
  const std::filesystem::path models = folder / "models";
  std::filesystem::copy(kTree / "models", models, std::filesystem::copy_options::recursive);
  std::filesystem::create_directory(models / "parts/boulder");
  folder.Write("models/parts/boulder/part.yaml", R"(format: assay-part/1
name: boulder
initial: BO
units: {length: mm}
density: 700
friction: 0.25
solids: {body: {box: [[0, 0, 0], [120, 130, 110]]}}
stable_poses: {upright: [0, 0, -1], on-side: [0, -1, 0]}
)");
  const auto scenario = [&](const std::string& wanted) {
    return folder.Write("boulder.yaml", R"(format: assay-scenario/1
workcell: puma762-table
parts: {rock: {model: boulder, pose: {stable: upright, at: [0.55, -0.1]}}}
goal: [{located: {part: rock, stable: [)" + wanted +
                                            "]}}]\n");
  };
  const Ended moved = Assay({"check", scenario("on-side"), "--models", models});
  EXPECT_EQ(moved.code, 12) << moved.err;
  EXPECT_THAT(moved.out,
              HasSubstr("a goal wants rock moved, and no grasp of the gripper holds it"));
  const Ended stays = Assay({"check", scenario("upright"), "--models", models});
  EXPECT_EQ(stays.code, 0) << stays.err;
}

TEST(Check, PartsAndWorkcells) {
  const Ended ended = Assay({"check", kBlock, kTable});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, AllOf(HasSubstr("face-down"), HasSubstr("BG1 "), HasSubstr("tool_lean")));
  EXPECT_THAT(ended.out,
              AllOf(ContainsRegex(R"(coarse-camera +\+-0\.3 +\+-0\.3 +unknown +\+-0\.2)"),
                    HasSubstr("gripper-opening  pickup    gripper-opening  1 mm  error1"),
                    HasSubstr("error1         groping-search  10 mm   3 mm")));
}

TEST(Check, GoesOnAfterAWrongFile) {
  const Folder folder;
  const std::string wrong = folder.Write("wrong.yaml", "format: assay-prat/1\n");
  const Ended ended = Assay({"check", wrong, kTable, "--json"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, StartsWith("assay: " + wrong + ":1:9: "));
  EXPECT_THAT(ended.err, HasSubstr("assay-part/1"));
  EXPECT_TRUE(ended.Json()["files"][0].contains("error"));
  EXPECT_EQ(ended.Json()["files"][1]["workcell"], "puma762-table");
}

// A plan whose pickup takes the part from a place where it does not lie.
class FlawedPlan : public ::testing::Test {
 protected:
  FlawedPlan() {
    auto plan = Assay({"plan", kTwoActions, "--json"}).Json();
    plan["actions"][1]["place"]["X_WorldPart"][3][0] = 0.7;
    file_ = folder_.Write("plan.json", plan.dump());
  }

  const Folder folder_;
  std::string file_;
};

TEST_F(FlawedPlan, IsFoundOut) {
  const Ended ended = Assay({"check", file_, "--json"});
  EXPECT_EQ(ended.code, 12) << ended.err;
  EXPECT_EQ(ended.Json()["files"][0]["holds"], false);
  const auto flaws = ended.Json()["files"][0]["check"]["flaws"];
  ASSERT_THAT(flaws, Not(IsEmpty()));
  // The plan file is one line.
  EXPECT_EQ(flaws[0]["line"], 1);
  EXPECT_GT(flaws[0]["column"], 1);
  EXPECT_THAT(Assay({"check", file_}).out, HasSubstr("  " + file_ + ":1:"));
}

TEST_F(FlawedPlan, IsNotExecuted) {
  const Ended ended = Assay({"run", file_, "-o", folder_ / "out"});
  EXPECT_EQ(ended.code, 12) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("flaws: "));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/trace.jsonl"));
}

// Files without a plan. Their answers are proved by the planner or not at all.
class AnswerWithoutPlan : public ::testing::Test {
 protected:
  static nlohmann::json AnswerFor(const std::string& scenario) {
    return Assay({"plan", scenario, "--json"}).Json();
  }
  Ended Checked(const nlohmann::json& answer) const {
    return Assay({"check", folder_.Write("plan.json", answer.dump())});
  }
  void ExpectRefused(const nlohmann::json& answer, const std::string& flaw) const {
    const Ended ended = Checked(answer);
    EXPECT_EQ(ended.code, 12) << ended.err;
    EXPECT_THAT(ended.out, AllOf(HasSubstr(flaw), Not(HasSubstr("No plan exists"))));
  }

  const Folder folder_;
};

TEST_F(AnswerWithoutPlan, IsProvedAnew) {
  const Ended ended = Checked(AnswerFor(kImpossible));
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("No plan exists"));
}

TEST_F(AnswerWithoutPlan, IsRefusedIfThereIsAPlan) {
  nlohmann::json answer = AnswerFor(kImpossible);
  const nlohmann::json possible = AnswerFor(kTwoActions);
  for (const char* key : {"scenario", "problem"}) answer[key] = possible[key];
  ExpectRefused(answer, "the file says that no plan exists, but the planner finds one");
}

TEST_F(AnswerWithoutPlan, IsRefusedIfTheFileHasAPlan) {
  nlohmann::json answer = AnswerFor(kTwoActions);
  answer["outcome"] = "budget";
  ExpectRefused(answer, "the file says that there is no plan, but has one");
  answer["outcome"] = "none";
  answer["conflict"] = {"the block starts face-down"};
  ExpectRefused(answer, "the file says that there is no plan, but has one");
}

TEST_F(AnswerWithoutPlan, IsRefusedWithOtherReasons) {
  nlohmann::json answer = AnswerFor(kImpossible);
  answer["conflict"].erase(0);
  ExpectRefused(answer, "the file gives other reasons than the planner why no plan exists");
}

TEST(Check, TellsWhatAnArmIs) {
  const std::string puma = kTree / "models/robots/puma762/puma762.urdf";
  const Ended text = Assay({"check", puma, "--poses", "50"});
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out,
              AllOf(HasSubstr("spherical wrist: axes 4, 5 and 6 meet in one point"),
                    HasSubstr("A pose has 8 to 8 solutions"),
                    HasSubstr("Nothing is missing for physics."), HasSubstr("urdf: puma762.urdf")));
  const auto arm = Assay({"check", puma, "--poses", "50", "--json"}).Json()["files"][0];
  EXPECT_EQ(arm["joints"][1]["name"], "shoulder_lift");
  EXPECT_EQ(arm["solutions"]["most"], 8);
  EXPECT_LT(arm["pose_error"], 1e-9);
  EXPECT_LT(arm["return_error"], 1e-6);
  EXPECT_TRUE(arm["closed_form"]);
  EXPECT_NEAR(arm["reach"]["farthest"], 0.65 + 0.6 + 0.125 + 0.02, 0.05);
}

TEST(Check, RefusesAnArmWithoutTheNamedLink) {
  const Ended ended =
      Assay({"check", kTree / "models/robots/puma762/puma762.urdf", "--tip", "tool0"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("puma762.urdf:"), HasSubstr("has no link 'tool0'")));
}

}  // namespace
}  // namespace assay::cli::check_test
