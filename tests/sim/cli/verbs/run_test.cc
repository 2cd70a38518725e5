#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/sim/cli/program.h"

namespace assay::cli::run_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

// One trial is run with pictures.
TEST(Run, AssemblesThePegAndLeavesItsFiles) {
  const Folder folder;
  const Ended ended = Assay({"run", kTwoActions, "-o", folder / "out", "--renders", "--size",
                             "64x48", "--camera", "close"});
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("pickup(peg, "));
  EXPECT_THAT(ended.out, HasSubstr("seated depth of peg in block"));
  EXPECT_THAT(ended.out, HasSubstr("1 of 1 trials succeeded"));
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
    files.push_back(entry.path().filename());
  }
  std::ranges::sort(files);
  EXPECT_THAT(files,
              ElementsAre("00-start.png", "01-action_2-1-closed.png", "01-action_2.png",
                          "02-action_1-1-before.png", "02-action_1-2-enters.png",
                          "02-action_1-3-half.png", "02-action_1-4-seated.png", "02-action_1.png",
                          "contact-sheet.png", "plan.json", "result.json", "trace.jsonl"));
}

// Trials of a plan file on two threads write the same bytes as trials of the scenario on one.
TEST(Run, NumberOfThreadsChangesNothing) {
  const Folder folder;
  const Ended one = Assay({"run", kTwoActions, "-o", folder / "one", "--trials", "2", "--json"});
  const Ended two = Assay({"run", folder / "one/plan.json", "-o", folder / "two", "--trials", "2",
                           "--jobs", "2", "--json"});
  ASSERT_EQ(one.code, 0) << one.err;
  ASSERT_EQ(two.code, 0) << two.err;
  for (const char* file : {"plan.json", "trace.jsonl", "trace-2.jsonl", "result.json"}) {
    EXPECT_EQ(TextOf(folder / ("one/" + std::string(file))),
              TextOf(folder / ("two/" + std::string(file))))
        << file;
  }
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/run.schema.json", one.Json()), IsEmpty());
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/run.schema.json", JsonOf(folder / "two/result.json")),
              IsEmpty());
  EXPECT_EQ(one.Json()["trials"], 2);
  EXPECT_EQ(one.Json()["succeeded"], 2);
  EXPECT_FALSE(JsonOf(folder / "one/result.json").contains("seconds"));
}

// Each trial draws from its own random stream. Run alone, it has the same result as in the series.
TEST(Run, ScatteredTrialsDependOnTheirNumberAlone) {
  const Folder folder;
  const auto scatter = [&](const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"run", kTwoActions, "--scatter", "--seed",
                                          "4",   "-o",        folder / out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(Assay(arguments).code, 0);
    return JsonOf(folder / (out + "/result.json"));
  };
  const auto both = scatter("both", {"--trials", "2", "--jobs", "2"});
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/run.schema.json", both), IsEmpty());
  ASSERT_EQ(both["rows"].size(), 2u);
  const auto second = scatter("second", {"--trial", "2"});
  ASSERT_EQ(second["rows"].size(), 1u);
  EXPECT_EQ(second["rows"][0], both["rows"][1]);
}

TEST(Run, AFalsificationTellsWhatCameNearestToBeingViolated) {
  const Ended ended = Assay({"run", kTwoActions, "--noise", "attack", "--attempts", "4", "--json"});
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  const nlohmann::json result = ended.Json();
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/run.schema.json", result), IsEmpty());
  EXPECT_EQ(result["grasp"], "friction");
  EXPECT_FALSE(result["worst"].empty());
  EXPECT_THAT(result["not_attempted"], IsEmpty());
  EXPECT_THAT(result["counterexamples"], IsEmpty());
}

TEST(Run, AFalsificationTellsWhichStepsItDidNotAttempt) {
  const std::vector<std::string> attack = {"run",    kTwoActions,  "--noise",
                                           "attack", "--attempts", "1"};
  const Ended ended = Assay(attack);
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("not falsified in 1 attempt\nno attempt was made at step 2, so "
                                   "nothing is known about it\n"));
}

// The ledger holds the errors that were drawn for a trial, and their effects.
TEST(Run, ASingleTrialUnderNoiseHasALedger) {
  const Folder folder;
  const Ended ended = Assay({"run", kTwoActions, "--errors", "dx_peg=4e-5 theta_hand@action_2=1e-4",
                             "-o", folder / "out"});
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  EXPECT_THAT(ended.out, HasSubstr("drawn  applied  measured"));
  EXPECT_THAT(ended.out, ContainsRegex("dx_peg +mm +[+]0.0400 +[+]0.0400 +[+]0.0"));
  EXPECT_THAT(ended.out, ContainsRegex("theta_hand@action_2 +deg +[+]0.0057 +[+]0.0057 +[+]0.0"));
  const nlohmann::json result = JsonOf(folder / "out/result.json");
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/run.schema.json", result), IsEmpty());
  std::map<std::string, nlohmann::json> ledger;
  for (const nlohmann::json& entry : result["ledger"]) ledger[entry["name"]] = entry;
  EXPECT_EQ(ledger.size(), 16u);  // four for each part, and four for the hand in each action
  EXPECT_EQ(ledger["theta_hand@action_2"]["unit"], "rad");
  EXPECT_EQ(ledger["theta_hand@action_2"]["drawn"], 1e-4);
  EXPECT_NEAR(ledger["theta_hand@action_2"]["measured"], 1e-4, 1e-5);
  EXPECT_NEAR(ledger["dx_peg"]["measured"], 4e-5, 3e-6);
  EXPECT_NEAR(ledger["dy_peg"]["measured"], 0, 3e-6);
}

TEST(Run, WhatHasNoPlanIsNotExecuted) {
  const Ended ended = Assay({"run", kImpossible});
  EXPECT_EQ(ended.code, 10) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("No plan exists"));
}

// The grip is too weak, and the peg slips out of the hand. The trial is judged by the peg's true
// pose and not by the believed one.
TEST(Run, TrialThatFails) {
  const Folder folder;
  const std::string weak =
      folder.Write("weak.yaml", TextOf(kTwoActions) + "rules: {grip_force: 0.5}\n");
  const Ended ended = Assay({"run", weak, "--models", kTree / "models", "--json"});
  EXPECT_EQ(ended.code, 12) << ended.err;
  const auto json = ended.Json();
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/run.schema.json", json), IsEmpty());
  EXPECT_EQ(json["succeeded"], 0);
  EXPECT_EQ(json["failed"].size(), 1);
  EXPECT_NE(json["first"]["reason"], "");
  EXPECT_EQ(json["replay"][0],
            "assay run " + weak + " --models " + (kTree / "models").string() + " --seed 0");
}

TEST(Run, ExecutesWhatWasInserted) {
  for (const std::string& scenario : {kTwoLooks, kTwoSqueezes}) {
    const Ended ended = Assay({"run", scenario, "--json"});
    EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
    EXPECT_EQ(ended.Json()["first"]["steps"].size(), 4) << scenario;
  }
}

TEST(Render, TakesPicturesOfWhatWasInserted) {
  const Folder folder;
  const Ended ended = Assay({"render", kTwoSqueezes, "-o", folder / "out", "--size", "32x24",
                             "--camera", "close", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  // Five pictures show the start, two squeezes and two actions. Three show closed pads, four the
  // mating, and one is the contact sheet.
  std::vector<std::string> names = ended.Json()["pictures"];
  EXPECT_EQ(names.size(), 5 + 3 + 4 + 1);
  EXPECT_TRUE(std::ranges::is_sorted(names)) << "not in the order of execution";
}

TEST(Render, TellsItsFiles) {
  const Folder folder;
  const Ended ended = Assay({"render", kTwoActions, "-o", folder / "out", "--size", "32x24",
                             "--camera", "top", "work", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  // Three snapshots are taken by two cameras. Five pictures are close-ups, and one is the contact
  // sheet.
  EXPECT_EQ(ended.Json()["pictures"].size(), 12);
  for (const std::string name : ended.Json()["pictures"]) {
    EXPECT_TRUE(std::filesystem::exists(folder / ("out/" + name))) << name;
  }
}

TEST(Render, UnknownCamera) {
  const Folder folder;
  const Ended ended =
      Assay({"render", kTwoActions, "-o", folder / "out", "--size", "64x48", "--camera", "clsoe"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("close"));
}

TEST(Export, Mjcf) {
  const Folder folder;
  const Ended ended = Assay({"export", kTwoActions, "--mjcf", "-o", folder / "scene.xml"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(TextOf(folder / "scene.xml"), StartsWith("<mujoco"));
}

TEST(Export, Dot) {
  const Ended ended = Assay({"export", kTwoActions, "--dot"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, StartsWith("digraph "));
  EXPECT_THAT(ended.out, HasSubstr("\"action_2\" -> \"action_1\";"));
}

TEST(Export, WhatWasInserted) {
  const Ended dot = Assay({"export", kTwoLooks, "--dot"});
  EXPECT_EQ(dot.code, 0) << dot.err;
  EXPECT_THAT(dot.out,
              HasSubstr("\"action_3\" [label=\"1 sense(sleeve, overhead-camera, initial)\"];"));
  EXPECT_THAT(dot.out, HasSubstr("\"action_3\" -> \"action_2\";"));
  const Ended commands = Assay({"export", kTwoSqueezes, "--commands"});
  EXPECT_EQ(commands.code, 0) << commands.err;
  EXPECT_THAT(commands.out, HasSubstr("squeeze(post"));
  EXPECT_THAT(commands.out, HasSubstr("open, releasing post"));
}

// The worked example is Spar's figure 9, with the path init_pos_1 - grasp_2 - pos_1 - grasp_1 -
// init_pos_2.
TEST(Export, NetworkOfTheWorkedExample) {
  const Ended ended = Assay({"export", kTree / "scenarios/spar-example.yaml", "--network"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  int reachable = 0;
  int mate_reachable = 0;
  std::istringstream lines(ended.out);
  for (std::string line; std::getline(lines, line);) {
    reachable += line.ends_with("[label=reachable];");
    mate_reachable += line.ends_with("[label=mate_reachable];");
  }
  EXPECT_EQ(reachable, 3);
  EXPECT_EQ(mate_reachable, 1);
}

// The export has as many states and arcs as `mate` counts. It has a bold edge for each state that
// two graphs share.
TEST(Export, ContactStatesOfAMating) {
  const std::string square = kTree / "scenarios/mate-square.yaml";
  const Ended ended = Assay({"export", square, "--contacts"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  int states = 0;
  int arcs = 0;
  int shared = 0;
  std::istringstream lines(ended.out);
  for (std::string line; std::getline(lines, line);) {
    states += line.starts_with("  c") && line.find("[label=") != std::string::npos;
    const bool is_edge = line.find(" -- ") != std::string::npos;
    const bool is_bold = line.find("style=bold") != std::string::npos;
    arcs += is_edge && !is_bold;
    shared += is_edge && is_bold;
  }
  const nlohmann::json graphs = Assay({"mate", square, "--json"}).Json()["graphs"];
  ASSERT_EQ(graphs.size(), 2u);
  EXPECT_EQ(graphs[0]["states"].get<int>() + graphs[1]["states"].get<int>(), states);
  EXPECT_EQ(graphs[0]["arcs"].get<int>() + graphs[1]["arcs"].get<int>(), arcs);
  EXPECT_EQ(graphs[0]["goals"], shared);
  EXPECT_EQ(Assay({"export", square, "--dot", "--contacts"}).out, ended.out);
  EXPECT_EQ(Assay({"export", kTree / "scenarios/uncertain-sensing.yaml", "--contacts"}).code, 0);
}

TEST(Export, CommandsOfThePrimitives) {
  const Ended ended = Assay({"export", kTwoActions, "--commands"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("pickup(peg"));
  EXPECT_THAT(ended.out, HasSubstr("close"));
}

}  // namespace
}  // namespace assay::cli::run_test
