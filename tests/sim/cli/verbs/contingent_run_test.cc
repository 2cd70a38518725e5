#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::contingent_run_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

const std::string kTwoCans = kTree / "scenarios/two-cans.yaml";

// A trial depends on the seed and on its own number alone.
TEST(ContingentRun, TrialsAreTheSameAloneAndOnAnyNumberOfThreads) {
  const Ended both = Assay({"run", kTwoCans, "--trials", "2", "--jobs", "2", "--json"});
  EXPECT_EQ(both.code, 0) << both.err << both.out;
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/contingent_run.schema.json", both.Json()), IsEmpty());
  EXPECT_EQ(both.Json()["reached"], 2);
  EXPECT_EQ(both.Json()["leaves"].size(), 4);
  const Ended alone = Assay({"run", kTwoCans, "--trial", "2", "--json"});
  EXPECT_EQ(alone.Json()["rows"][0], both.Json()["rows"][1]);
}

TEST(ContingentRun, AFalseClaimFailsATrialWithTheGoalReached) {
  const Ended ended = Assay({"run", kTwoCans, "--sensing-errors", "1"});
  EXPECT_EQ(ended.code, 12);
  EXPECT_THAT(
      ended.out,
      AllOf(HasSubstr("trial 1: false-claim: after step 2 isSpillable(can1) is claimed"),
            HasSubstr("; the goal is true"), HasSubstr("--sensing-errors 1 --seed 0 --trial 1"),
            HasSubstr("made wrong in 1 trials; the audit noticed it in 1")));
}

// The models' folder was given, so the command that repeats the trial must give it as well.
TEST(ContingentRun, TheCommandThatRepeatsATrialNamesTheModels) {
  const std::string models = kTree / "models";
  const Ended ended =
      Assay({"run", kTwoCans, "--sensing-errors", "1", "--models", models, "--json"});
  EXPECT_EQ(ended.code, 12) << ended.err;
  EXPECT_EQ(ended.Json()["replay"][0], "assay run " + kTwoCans + " --models " + models +
                                           " --sensing-errors 1 --seed 0 --trial 1");
}

// Without the place that both arms reach, no bottle can be handed over. Planning and running report
// the same reasons.
TEST(ContingentRun, PlanAndRunNameThePartsThatNoGraspServes) {
  const Folder folder;
  std::filesystem::copy(kTree / "scenarios/know", folder / "know");
  std::string problem = TextOf(folder / "know/one-bottle.pks");
  for (const std::string word :
       {" shared,", "isReachable(shared, left),", "isReachable(shared, right),"}) {
    problem.erase(problem.find(word), word.size());
  }
  folder.Write("know/one-bottle.pks", problem);
  const std::string scenario =
      folder.Write("scenario.yaml", TextOf(kTree / "scenarios/bottles.yaml"));
  const std::string models = kTree / "models";
  const Ended run = Assay({"run", scenario, "--models", models});
  const Ended plan = Assay({"plan", scenario, "--models", models});
  EXPECT_EQ(run.code, 11) << run.err;
  EXPECT_EQ(plan.code, 11) << plan.err;
  EXPECT_EQ(plan.out, run.out);
  EXPECT_THAT(plan.out, HasSubstr("No grasp serves:\n  bottle (dishwasher, left): none of its "));
  const nlohmann::json answer = Assay({"plan", scenario, "--models", models, "--json"}).Json();
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/contingent.schema.json", answer), IsEmpty());
  EXPECT_EQ(answer["not_served"],
            Assay({"run", scenario, "--models", models, "--json"}).Json()["not_served"]);
}

TEST(ContingentRun, PicturesOfEachStep) {
  if (Assay({"doctor", "--json"}).Json()["renderer"] == "") {
    GTEST_SKIP() << "nothing renders on this machine";
  }
  const Folder folder;
  const Ended ended = Assay({"run", kTwoCans, "--renders", "-o", folder / "out", "--camera", "top",
                             "--size", "120x90", "--json"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* name :
       {"00-start.png", "01-grasp-can1.png", "08-ungrasp-can2.png", "contact-sheet.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / (std::string("out/") + name))) << name;
  }
}

// The steps are printed in the words of assembly plans. No part can spill.
TEST(ContingentRun, AnAssembly) {
  const Ended ended = Assay({"run", kTree / "scenarios/uncertain-known.yaml", "--tree"});
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_THAT(ended.out, AllOf(HasSubstr(" pickup("), HasSubstr(" assemble("),
                               Not(HasSubstr("plan1-")), Not(HasSubstr("tilt"))));
}

TEST(ContingentRun, WrongScenarios) {
  const Ended none = Assay({"run", kTree / "scenarios/impossible.yaml", "--tree"});
  EXPECT_EQ(none.code, 10) << none.err;
  EXPECT_THAT(none.out, HasSubstr("The nearest misses:\n  - the tool would lean 45 deg"));
  const Folder folder;
  const std::string text = TextOf(kTwoCans);
  const std::string cut = folder.Write("cut.yaml", text.substr(0, text.find("    ungrasp: {")));
  const Ended ended = Assay({"run", cut, "--models", kTree / "models"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, StartsWith("assay: " + cut + ":"));
}

// The safe height is greater than the arms reach with the bottle, so that no grasp serves the
// bottle at any place.
TEST(ContingentRun, WithoutAPlanTellsWhatNoGraspServes) {
  const Folder folder;
  std::string text = TextOf(kTree / "scenarios/bottles.yaml");
  text.replace(text.find("parts:"), 6, "rules: {safe_height: 1300}\nparts:");
  for (std::size_t at = 0; (at = text.find(": know/", at)) != std::string::npos;) {
    text.replace(at, 2, ": " + (kTree / "scenarios").string() + "/");
  }
  const std::string high = folder.Write("high.yaml", text);
  const Ended ended = Assay({"run", high, "--models", kTree / "models"});
  EXPECT_EQ(ended.code, 11) << ended.err;
  EXPECT_THAT(ended.out,
              AllOf(HasSubstr("No plan was found. This does not prove that there is none"),
                    HasSubstr("bottle (tableRight, left): "),
                    HasSubstr("; the arm gets there from 1300 mm above the table")));
  const Ended json = Assay({"run", high, "--models", kTree / "models", "--json"});
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/contingent_run.schema.json", json.Json()), IsEmpty());
}

}  // namespace
}  // namespace assay::cli::contingent_run_test
