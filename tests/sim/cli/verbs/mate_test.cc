#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/sim/cli/program.h"

namespace assay::cli::mate_test {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kSquare = kTree / "scenarios/mate-square.yaml";
constexpr char kSchema[] = "sim/cli/verbs/mate.schema.json";

int CountOf(const std::string& word, const std::string& text) {
  int count = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(Mate, PlansAStrategyThatIsCertainForAllTheErrors) {
  const Ended ended = Assay({"mate", kSquare, "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json result = ended.Json();
  EXPECT_THAT(SchemaErrors(kSchema, result), IsEmpty());
  EXPECT_EQ(result["outcome"], "plan");
  EXPECT_EQ(result["critical_points"].size(), 2u);  // the tip at the mouth, the plate on the front
  EXPECT_GE(result["absorbed"], 1);
  EXPECT_GT(result["strategy"].size(), 2u);
  EXPECT_GT(result["margins"].size(), 2u);
  for (const auto& margin : result["margins"]) EXPECT_GT(margin["scale"], 1);
}

TEST(Mate, WithoutAStrategyThereIsNoPlan) {
  const Ended ended = Assay({"mate", kSquare, "--displacement", "5", "--rotation", "2.5"});
  EXPECT_EQ(ended.code, 10) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("; this is prevented by "));
  EXPECT_THAT(ended.out, HasSubstr("all sequences of the planner's maneuvers from"));
}

// The contact that is named as the obstacle happens only with errors beyond the certain scale. With
// greater errors this contact happens at a smaller multiple of these errors.
TEST(Mate, TheMarginOfTheObstacleIsOneOfTheErrors) {
  double last = 1;
  for (const auto& [displacement, rotation] : {std::pair("5", "2.5"), std::pair("10", "5")}) {
    const Ended ended =
        Assay({"mate", kSquare, "--displacement", displacement, "--rotation", rotation, "--json"});
    EXPECT_EQ(ended.code, 10) << ended.err;
    const nlohmann::json result = ended.Json();
    EXPECT_THAT(SchemaErrors(kSchema, result), IsEmpty());
    EXPECT_EQ(result["outcome"], "none");
    const double margin = result["obstacle"]["scale"];
    EXPECT_GT(margin, result["absorbed"].get<double>());
    EXPECT_LT(margin, 0.8 * last);
    last = margin;
  }
}

TEST(Mate, ASpentBudgetIsNoProof) {
  const Ended ended = Assay({"mate", kSquare, "--displacement", "5", "--nodes", "1"});
  EXPECT_EQ(ended.code, 11) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("; this is prevented by "));
  EXPECT_THAT(ended.out, HasSubstr("--nodes"));
}

// Each scenario is planned with its own errors.
TEST(Mate, EveryMatingScenarioHasAStrategy) {
  for (const std::string name : {"keyed", "octagonal", "square", "stepped", "t-slot"}) {
    const Ended ended = Assay({"mate", kTree / ("scenarios/mate-" + name + ".yaml")});
    EXPECT_EQ(ended.code, 0) << name << ": " << ended.out;
  }
}

TEST(Mate, ErrorsOnTheCommandLineReplaceTheScenarios) {
  const Folder folder;
  const std::string errors = "mating_errors: {displacement: 2, rotation: 1}";
  std::string text = TextOf(kSquare);
  text.replace(text.find(errors), errors.size(), "mating_errors: {displacement: 0.5, rotation: 0.2}");
  const std::string file = folder.Write("little.yaml", text);
  const std::string models = kTree / "models";
  const std::string out = Assay({"mate", kSquare}).out;
  EXPECT_NE(Assay({"mate", file, "--models", models}).out, out);
  EXPECT_EQ(
      Assay({"mate", file, "--models", models, "--displacement", "2", "--rotation", "1"}).out, out);
}

// The graphs lead from free space through a crevice of the mouth and one of the lips to the seat.
// Each critical point has a graph, and its goals are the next graph's initial states.
TEST(Mate, GraphsOfAllCriticalPointsAreAChain) {
  const Ended ended = Assay({"mate", kTree / "scenarios/mate-t-slot.yaml", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json result = ended.Json();
  EXPECT_THAT(SchemaErrors(kSchema, result), IsEmpty());
  const nlohmann::json& graphs = result["graphs"];
  ASSERT_EQ(graphs.size(), 3u);
  int motions = 0;
  for (std::size_t i = 0; i < graphs.size(); ++i) {
    const nlohmann::json one = 1;  // free space is the only initial state
    EXPECT_EQ(graphs[i]["initial"], i > 0 ? graphs[i - 1]["goals"] : one);
    EXPECT_GT(graphs[i]["goals"], 0);
    EXPECT_GT(graphs[i]["transitions"], 0);
    int states = 0;
    for (const int count : graphs[i]["dimensions"]) states += count;
    EXPECT_EQ(graphs[i]["states"], states);
    if (graphs[i].contains("strategy")) motions += graphs[i]["strategy"]["motions"].get<int>();
  }
  EXPECT_EQ(motions, result["strategy"].size());
  EXPECT_EQ(result["graph"]["states"], graphs[0]["states"]);
}

// The three critical points are the mouth, the lips and the plate's landing.
TEST(Mate, AStrategyLeadsThroughAllCriticalPoints) {
  const Ended ended =
      Assay({"mate", kTree / "scenarios/mate-t-slot.yaml", "--trials", "1", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json result = ended.Json();
  EXPECT_EQ(result["critical_points"].size(), 3u);
  EXPECT_GE(result["absorbed"], 1);
  EXPECT_EQ(result["trials"]["strategy"]["seated"], 1);
}

// No fixture holds the block against the forces of the strategy.
TEST(Mate, AFixturesAbsenceIsTold) {
  const Ended ended = Assay({"mate", kTree / "scenarios/keyed.yaml", "--trials", "1"});
  EXPECT_EQ(ended.code, 12) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("declare a fixture with the key `clamp` of block"));
}

// The block stands on one end, and the plan lays it down before the mating.
TEST(Mate, TheFixedPartLiesWhereThePlanHasPutIt) {
  const Folder folder;
  std::string text = TextOf(kTree / "scenarios/keyed.yaml");
  const std::string model = "model: keyed-block\n";
  text.insert(text.find(model) + model.size(),
              "    clamp: 300\n");  // newtons, against the forces of the strategy
  const std::string file = folder.Write("clamped.yaml", text);
  const Ended ended =
      Assay({"mate", file, "--models", kTree / "models", "--trials", "1", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.Json()["trials"]["strategy"]["seated"], 1);
}

// At the edge of its reach, the arm can come straight to the hole, but not with every tilt. The
// result says that the budget was spent. It does not say that there is no plan, because a search
// from another seed may find a strategy that the arm can execute.
TEST(Mate, WhereTheArmDoesNotReachNoPlanIsFound) {
  const Folder folder;
  std::string text = TextOf(kSquare);
  const std::string at = "at: [600, 50]";
  text.replace(text.find(at), at.size(), "at: [870, 310]");
  const std::string file = folder.Write("far.yaml", text);
  int unreached = 0;
  for (const char* seed : {"1", "2", "3", "4", "5", "6"}) {
    const std::vector<std::string> command = {
        "mate", file, "--models", kTree / "models", "--clearance", "0.5", "--search-seed", seed};
    const Ended told = Assay(command);
    if (told.code == 0) continue;
    ++unreached;
    EXPECT_EQ(told.code, 11) << told.out;
    EXPECT_THAT(told.out, HasSubstr("the arm cannot execute the strategy with any grasp"));
    EXPECT_THAT(told.out, HasSubstr("where "));
    std::vector<std::string> with_trials = command;
    with_trials.insert(with_trials.end(), {"--trials", "1", "--json"});
    const nlohmann::json result = Assay(with_trials).Json();
    EXPECT_THAT(SchemaErrors(kSchema, result), IsEmpty());
    EXPECT_EQ(result["outcome"], "budget");
    EXPECT_TRUE(result["unreached"]["obstacle"].is_null());
    EXPECT_FALSE(result.contains("trials"));
  }
  EXPECT_GT(unreached, 0);
}

// The errors are far beyond those that the plan covers. The first ones drawn may put the held part
// inside of the block.
TEST(Mate, ErrorsWithWhichNoTrialCanBeginAreDrawnAnew) {
  const Ended ended = Assay({"mate", kSquare, "--beyond", "12", "--trial", "9", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json row = ended.Json()["trials"]["rows"][0];
  EXPECT_THAT(SchemaErrors(kSchema, ended.Json()), IsEmpty());
  EXPECT_GT(row["redrawn"], 0);
  EXPECT_GT(row["simulated"], 1) << "it began";
}

// A trial that is run alone has the same result as in the series.
TEST(Mate, AFewTrialsComeToTheSeat) {
  const Ended ended = Assay({"mate", kSquare, "--clearance", "0.5", "--trials", "2", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json trials = ended.Json()["trials"];
  EXPECT_THAT(SchemaErrors(kSchema, ended.Json()), IsEmpty());
  EXPECT_EQ(trials["strategy"]["seated"], 2);
  EXPECT_EQ(trials["sequences"]["covered"], 2);
  EXPECT_GT(trials["sequences"]["points"], 100);
  // The engine may report a force at a seam between a part's pieces, where the model has no edge.
  EXPECT_LT(trials["sequences"]["unmapped"], trials["sequences"]["points"].get<int>() / 100);
  for (const auto& row : trials["rows"]) {
    EXPECT_EQ(row["sequence"]["matches"], row["sequence"]["divergence"].is_null());
    EXPECT_EQ(row["sequence"]["matches"], row["sequence"]["edit_distance"] == 0);
  }
  const Ended again = Assay({"mate", kSquare, "--clearance", "0.5", "--trial", "2", "--json"});
  EXPECT_EQ(again.Json()["trials"]["rows"][0], trials["rows"][1]);
}

// The strategy comes to its end without contact, and nothing told it that the part is not seated.
TEST(Mate, ATrialThatIsNotSeatedHasAReason) {
  const std::string folder = kTree / "tests/sim/check/measurements/wide-hole";
  const std::vector<std::string> command = {
      "mate",     folder + "/scenario.yaml", "--models", folder,
      "--models", kTree / "models",          "--trial",  "2"};
  EXPECT_THAT(
      Assay(command).out,
      ContainsRegex("  trial 2: done: (seated depth|lateral error) of [a-z]+ in [a-z]+: [.0-9]+ m, "
                    "limit [.0-9]+ m\n"));
}

// If two edges are near each other on the same rim, the second one takes over the first one's load.
// Errors that are covered, but greater than those planned for, bring the edges still nearer.
TEST(Mate, WhatIsKeptIsNotLiftedByTheNextContact) {
  for (const std::vector<std::string>& errors :
       {std::vector<std::string>{"--clearance", "0.2", "--trial", "24"},
        std::vector<std::string>{"--beyond", "1.35", "--trial", "7"}}) {
    std::vector<std::string> command = {"mate", kSquare, "--friction", "0.2", "--json"};
    command.insert(command.end(), errors.begin(), errors.end());
    const Ended ended = Assay(command);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.Json()["trials"]["sequences"]["covered_matching"], 1);
  }
}

// The verb writes a picture of each motion, one of all motions, the graphs, and a page that shows
// them.
TEST(Mate, PicturesOfTheContactStates) {
  const Folder folder;
  const std::string pictures = folder / "pictures";
  const Ended ended = Assay({"mate", kSquare, "--pictures", pictures, "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const nlohmann::json result = ended.Json();
  EXPECT_THAT(SchemaErrors(kSchema, result), IsEmpty());
  // The end of the slide is one more state.
  const int states = static_cast<int>(result["strategy"].size()) + 1;
  EXPECT_EQ(static_cast<int>(result["pictures"].size()), states + 4);
  for (const std::string file : result["pictures"])
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(pictures) / file)) << file;
  int point = 0;
  for (const nlohmann::json& graph : result["graphs"]) {
    const std::string drawn = TextOf(pictures + "/graph-" + std::to_string(++point) + ".svg");
    EXPECT_EQ(CountOf("class=\"state\"", drawn), graph["states"]);
    EXPECT_EQ(CountOf("class=\"goal\"", drawn), graph["goals"]);
  }
  EXPECT_EQ(point, 2);
  const std::string page = TextOf(pictures + "/index.html");
  EXPECT_EQ(CountOf("<img", page), states);
  EXPECT_EQ(CountOf("<svg", page), 2);
}

}  // namespace
}  // namespace assay::cli::mate_test
