#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::plan_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kSchema = "planner/plan/plan_files/plan.schema.json";

// The planner inserts the assemble first and the pickup second, but the pickup is executed first.
TEST(Plan, TableIsInTheOrderOfExecution) {
  const Ended ended = Assay({"plan", kTwoActions});
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::size_t pickup = ended.out.find("1         2  action_2  pickup(peg, ");
  const std::size_t assemble = ended.out.find("2         1  action_1  assemble(peg, block, ");
  ASSERT_NE(pickup, std::string::npos) << ended.out;
  ASSERT_NE(assemble, std::string::npos) << ended.out;
  EXPECT_LT(pickup, assemble);
}

TEST(Plan, JsonFollowsTheSchemaAndHasSeconds) {
  const Ended ended = Assay({"plan", kTwoActions, "--json", "--instances", "3", "--check"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(SchemaErrors(kSchema, ended.Json()), IsEmpty());
  EXPECT_GE(ended.Json()["seconds"], 0);
  EXPECT_EQ(ended.Json()["instances"].size(), 3);
  EXPECT_NE(ended.Json()["instances"][0], ended.Json()["instances"][1]);
  EXPECT_THAT(ended.Json()["check"]["flaws"], IsEmpty());
}

TEST(Plan, FileIsTheSameEachTimeAndHasNoSeconds) {
  const Folder folder;
  ASSERT_EQ(Assay({"plan", kTwoActions, "-o", folder / "a.json"}).code, 0);
  ASSERT_EQ(Assay({"plan", kTwoActions, "-o", folder / "b.json", "--json", "--check"}).code, 0);
  EXPECT_EQ(TextOf(folder / "a.json"), TextOf(folder / "b.json"));
  EXPECT_THAT(SchemaErrors(kSchema, JsonOf(folder / "a.json")), IsEmpty());
  EXPECT_FALSE(JsonOf(folder / "a.json").contains("seconds"));
  EXPECT_THAT(folder.Contents(), ElementsAre("a.json", "b.json"));
}

TEST(Plan, TableTellsWhatIsProved) {
  const Ended ended = Assay({"plan", kTwoActions});
  EXPECT_THAT(ended.out, ContainsRegex("pickup\\(peg, .*\\)  +[0-9]+ proved\n"));
  EXPECT_THAT(ended.out, ContainsRegex("assemble\\(peg, .*\\)  +[0-9]+ proved\n"));
  EXPECT_THAT(ended.out,
              HasSubstr("Every precondition is proved. No precondition covers the effects that are "
                        "listed below. Nothing was inserted.\n"));
}

// Fine motion is used where looks and squeezes are not enough, and it is reported.
TEST(Plan, TellsOfTheStrategyThatAbsorbsErrors) {
  const std::string scenario = kTree / "scenarios/uncertain-fine-motion.yaml";
  const Folder folder;
  const Ended ended = Assay({"plan", scenario, "-o", folder / "plan.json", "--check"});
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_THAT(ended.out,
              ContainsRegex("assemble\\(peg, .*\\) +[0-9]+ of [0-9]+ proved, [0-9]+ abs"));
  EXPECT_THAT(ended.out, HasSubstr("for step 3: fine-motion, because\n"));
  EXPECT_THAT(ended.out, ContainsRegex("motions by contacts, in spite of errors of the tip of "));
  EXPECT_THAT(
      ended.out,
      HasSubstr(
          "Every precondition is proved, or absorbed by fine motion. No precondition covers"));
  EXPECT_THAT(SchemaErrors(kSchema, JsonOf(folder / "plan.json")), IsEmpty());
  const Ended explained = Assay({"plan", folder / "plan.json", "--explain", "3"});
  // The same step can be named by the id that is printed.
  for (const nlohmann::json& action : JsonOf(folder / "plan.json")["actions"]) {
    if (action["executed"] != 3) continue;
    const std::string id = action["id"];
    EXPECT_EQ(Assay({"plan", folder / "plan.json", "--explain", id}).out, explained.out) << id;
  }
  EXPECT_THAT(explained.out, HasSubstr(" cases, and absorbed by fine motion\n"));
  EXPECT_THAT(explained.out, HasSubstr("tip shift: the tip is displaced by less than"));
  const Ended without = Assay({"plan", scenario, "--resolvers", "sensing,squeezing"});
  EXPECT_THAT(without.out, HasSubstr("Some preconditions of 1 step are not proved"));
  const Ended unknown = Assay({"plan", scenario, "--resolvers", "luck"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("fine-motion"));
}

// The part may lie in the hand with any turn.
TEST(Plan, FineMotionIsNoHelpForErrorsOfARightAngle) {
  const Ended ended = Assay({"plan", kUnproved, "--resolvers", "sensing,squeezing,fine-motion"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("Some preconditions of 2 steps are not proved"));
}

TEST(Plan, TellsWhatWasInsertedForWhichStep) {
  const Ended ended = Assay({"plan", kTwoLooks});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("1         3  action_3  sense(sleeve, overhead-camera, "));
  EXPECT_THAT(ended.out, HasSubstr("for step 4: sensing (step 3), because\n"));
  EXPECT_THAT(ended.out, HasSubstr("Every precondition is proved. No precondition covers the "
                                   "effects that are listed below.\n"));
}

TEST(Plan, TellsWhatStandsByForAnError) {
  const Ended ended = Assay({"plan", kUnproved});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, ContainsRegex("pickup\\(peg, .*\\)  +[0-9]+ of [0-9]+ proved\n"));
  EXPECT_THAT(
      ended.out,
      HasSubstr("verification gripper-opening: the expected gripper-opening is 76.2 +- 1 mm; less "
                "means error1 (groping-search within 10 mm); more means error2 (call-operator)\n"));
  EXPECT_THAT(ended.out, HasSubstr("Some preconditions of 2 steps are not proved. The plan has 2 "
                                   "verifications and 4 recoveries for these steps.\n"));
}

TEST(Plan, CertificatesFollowTheSchema) {
  for (const std::string& scenario : {kTwoLooks, kTwoSqueezes, kUnproved}) {
    const Ended ended = Assay({"plan", scenario, "--json", "--check"});
    EXPECT_THAT(SchemaErrors(kSchema, ended.Json()), IsEmpty()) << scenario;
    EXPECT_THAT(ended.Json()["check"]["flaws"], IsEmpty()) << scenario;
  }
}

// The paper has four preconditions of a pickup. It takes the hand's error to be the same at all
// poses.
TEST(Plan, PropagationAsInThePaper) {
  const auto preconditions = [](const std::string& propagation) {
    const auto plan = Assay({"plan", kTwoActions, "--propagation", propagation, "--json"}).Json();
    return plan["actions"][1]["certificate"]["preconditions"].size();
  };
  EXPECT_EQ(preconditions("paper"), 4);
  EXPECT_GT(preconditions("sound"), 4);
}

TEST(Plan, PlanFileIsShownAsItIs) {
  const Folder folder;
  const Ended planned = Assay({"plan", kTwoLooks, "-o", folder / "plan.json"});
  const Ended shown = Assay({"plan", folder / "plan.json"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_EQ(shown.out.substr(0, shown.out.rfind("; ")),
            planned.out.substr(0, planned.out.rfind("; ")));
  const Ended wrong = Assay({"plan", folder / "plan.json", "--instances", "2"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--instances is for scenarios"));
}

// The output of --json is a plan file, which can be checked and executed.
TEST(Plan, PrintedJsonIsAPlanFile) {
  const Folder folder;
  const Ended planned = Assay({"plan", kTwoActions, "--json", "--instances", "2", "--check"});
  const Ended checked = Assay({"check", folder.Write("plan.json", planned.out)});
  EXPECT_EQ(checked.code, 0) << checked.err;
}

TEST(Plan, TraceGoesToStandardError) {
  const Ended silent = Assay({"plan", kTwoActions});
  const Ended traced = Assay({"plan", kTwoActions, "--trace"});
  EXPECT_EQ(silent.err, "");
  EXPECT_THAT(traced.err, HasSubstr("goal assembled(peg, block)"));
}

TEST(Plan, ProofThatThereIsNoneListsTheConflict) {
  const Folder folder;
  const Ended ended = Assay({"plan", kImpossible, "-o", folder / "plan.json"});
  EXPECT_EQ(ended.code, 10) << ended.err;
  EXPECT_THAT(ended.out,
              HasSubstr("No plan exists under these hypotheses:\n  - actions: pickup, putdown"));
  EXPECT_THAT(ended.out, HasSubstr("  - block starts face-down"));
  EXPECT_THAT(ended.out, HasSubstr("more than the limit of 10 deg"));
  const auto json = JsonOf(folder / "plan.json");
  EXPECT_EQ(json["outcome"], "none");
  EXPECT_GE(json["conflict"].size(), 2);
  EXPECT_GE(json["hypotheses"].size(), 3);
  EXPECT_GE(json["near_misses"].size(), 1);
}

TEST(Plan, AGoalThatHoldsAlreadyNeedsNothing) {
  const Folder folder;
  std::string text = TextOf(kTwoActions);
  text.erase(text.find("goal:"));
  const std::string scenario =
      folder.Write("there.yaml", text + "goal:\n  - located: {part: peg, stable: [on-side]}\n");
  const Ended ended = Assay({"plan", scenario, "--models", kTree / "models"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out,
              HasSubstr("The goal holds already at the believed poses: nothing is to be done.\n"
                        "Nothing is proved about errors of these poses.\n"));
  EXPECT_EQ(Assay({"run", scenario, "--models", kTree / "models"}).code, 0);
}

TEST(Plan, SpentBudget) {
  const Ended ended = Assay({"plan", kTwoActions, "--budget", "2", "--json"});
  EXPECT_EQ(ended.code, 11) << ended.err;
  EXPECT_EQ(ended.Json()["outcome"], "budget");
}

TEST(Plan, WrongInput) {
  const Folder folder;
  const std::string wrong =
      folder.Write("wrong.yaml", "format: assay-scenario/1\nwrokcell: puma762-table\n");
  const Ended ended = Assay({"plan", wrong, "--models", kTree / "models"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, StartsWith("assay: " + wrong + ":2:1: "));
  EXPECT_THAT(ended.err, HasSubstr("workcell"));
  EXPECT_EQ(Assay({"plan", folder / "none.yaml"}).code, 3);
}

}  // namespace
}  // namespace assay::cli::plan_test
