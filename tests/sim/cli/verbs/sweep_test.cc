#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <thread>

#include "tests/sim/cli/program.h"
#include "tests/sim/cli/slurm_cluster.h"

namespace assay::cli::sweep_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A sweep of one trial without noise and one with it, for parts in jigs and with a long timestep.
// The program around the physics is under test here.
class SweepVerb : public ::testing::Test {
 protected:
  SweepVerb() {
    folder_.Write("known.yaml", TextOf(kTwoActions) + "simulation: {timestep: 0.0005}\n");
    sweep_ = Write(1);
  }
  std::string Write(int trials, const std::string& more = "") const {
    return folder_.Write("sweep.yaml",
                         "format: assay-sweep/1\n"
                         "scenarios: [known.yaml]\n"
                         "noise: [none, uniform]\n"
                         "trials: " +
                             std::to_string(trials) + "\n" + more);
  }
  Ended Sweep(const std::string& database, std::vector<std::string> more) const {
    more.insert(more.begin(), {"sweep", sweep_, "--db", folder_ / database});
    return Assay(WithModels(more));
  }
  static std::vector<std::string> WithModels(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--models", (kTree / "models").string()});
    return arguments;
  }
  nlohmann::json Replayed(const std::string& database, const std::string& trial) const {
    const Ended ended =
        Assay(WithModels({"replay", folder_ / database, trial, "--json", "--renders", "--size",
                          "160x120", "-o", folder_ / "pictures"}));
    EXPECT_EQ(ended.code, 0) << ended.err;
    return ended.Json();
  }

  const Folder folder_;
  std::string sweep_;
};

// Expects the printed claims and margins to have the figures of the JSON, which are in SI units. A
// printed claim is for example "y of peg +0.038 in [-0.025, +0.025] mm, gate 0.016".
void ExpectUnitsOfPeople(const std::string& text, const nlohmann::json& verdicts) {
  for (const nlohmann::json& verdict : verdicts) {
    const std::string claim =
        std::regex_replace(verdict["claim"].get<std::string>(), std::regex("[^\\w ]"), "\\$&");
    const std::regex row(
        verdict["action"].get<std::string>() + " .*" + claim +
        R"( ([-+][\d.]+) in \[[^\]]*\] (mm|deg), gate ([\d.]+) +([-\d.e]+) (mm|deg))");
    std::smatch match;
    ASSERT_TRUE(std::regex_search(text, match, row)) << claim << "\n" << text;
    const double unit = match[2] == "mm" ? 0.001 : std::acos(-1) / 180;
    const double margin = verdict["margin"];
    EXPECT_NEAR(std::stod(match[1]) * unit, verdict["observed"].get<double>(), 0.0006 * unit);
    EXPECT_NEAR(std::stod(match[3]) * unit, verdict["gate"].get<double>(), 0.0006 * unit);
    EXPECT_NEAR(std::stod(match[4]) * unit, margin, 0.001 * std::abs(margin));
    EXPECT_EQ(match[2], match[5]);
  }
}

// Adds to the first cell of a database an attack that found two counterexamples: an observation
// outside its range, and a statement that is false.
constexpr const char* kAddCounterexamples = R"py(
import sqlite3, sys
database = sqlite3.connect(sys.argv[1])
database.execute("INSERT INTO attack VALUES(1, 25, 23, 0, 2, 0, 98, 0, 2, 0)")
for row in ((1, 1, "2/after/y of peg", "action_1", "y of peg", "m", 0.0025, -0.001, 0.001, -0.0015),
            (1, 2, "2/after/end", "action_2", "comes to its end", "", 0, 1, 1, -1)):
    database.execute("INSERT INTO counterexample VALUES(?, ?, ?, ?, ?, ?, ?, ?, ?, ?, 0.00002,"
                     " 'dx_peg=0.001', 2, 1, 1, 'assay replay DB 4')", row)
database.commit()
database.close()
)py";

TEST_F(SweepVerb, TellsWhatWasViolatedInWords) {
  Sweep("a.sqlite", {});
  const Ended added = cli::Run("python3", {"-c", kAddCounterexamples, folder_ / "a.sqlite"});
  ASSERT_EQ(added.code, 0) << added.err;
  const Ended shown = Assay({"sweep", "show", folder_ / "a.sqlite"});
  EXPECT_THAT(shown.out, HasSubstr("  action_1: y of peg: 2.5 mm is not in [-1, 1] mm\n"));
  EXPECT_THAT(shown.out,
              HasSubstr("  action_2: the certificate says that the step comes to its end, "
                        "but it does not\n"));
}

TEST_F(SweepVerb, RunsGoesOnAndReplays) {
  const Ended ended = Sweep("a.sqlite", {"--json"});
  const nlohmann::json result = ended.Json();
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/sweep.schema.json", result), IsEmpty());
  EXPECT_EQ(result["trials"], 2);
  EXPECT_EQ(result["done"], 2);
  const bool good = result["succeeded"] == 2 && result["verdicts"]["violated"] == 0;
  EXPECT_EQ(ended.code, good ? 0 : 12) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("2 trials"));

  const Ended again = Sweep("a.sqlite", {});
  EXPECT_EQ(again.code, 3);
  EXPECT_THAT(again.err, AllOf(HasSubstr("a.sqlite"), HasSubstr("--resume")));
  const Ended resumed = Sweep("a.sqlite", {"--resume", "--json"});
  EXPECT_EQ(resumed.code, ended.code);
  EXPECT_EQ(resumed.Json(), result);

  const nlohmann::json replayed = Replayed("a.sqlite", "2");
  EXPECT_EQ(replayed["equal"], true) << replayed["differences"];
  EXPECT_EQ(replayed["stored"], replayed["again"]);
  ASSERT_EQ(replayed["again"]["verdicts"].size(), 2u);
  ExpectUnitsOfPeople(Assay(WithModels({"replay", folder_ / "a.sqlite", "2"})).out,
                      replayed["again"]["verdicts"]);
  // There are four errors for each part, and four for the hand in each action.
  EXPECT_EQ(replayed["ledger"].size(), 16u);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "pictures/contact-sheet.png"));
  EXPECT_EQ(Assay(WithModels({"replay", folder_ / "a.sqlite", "3"})).code, 2);

  Write(6);
  const Ended other = Sweep("a.sqlite", {"--resume"});
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr("the sweep file has changed"));
}

// With this long timestep and these small errors of the parts, the engine's errors without any
// noise are greater than the plan's error sets. Trials would prove nothing.
// The engine does not resolve a clearance of 2 micrometres.
TEST_F(SweepVerb, TellsOfAPlanThatCannotBeTested) {
  std::string text = TextOf(kTwoActions) + "simulation: {timestep: 0.001}\n";
  const std::string clearance = "\nclearance: 1\n";
  text.replace(text.find(clearance), clearance.size(), "\nclearance: 0.002\n");
  folder_.Write("known.yaml", text);
  Write(1, "error_scales: [0]\n");
  const Ended ended = Sweep("a.sqlite", {"--json"});
  EXPECT_EQ(ended.code, 12) << ended.err;
  const nlohmann::json result = ended.Json();
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/sweep.schema.json", result), IsEmpty());
  EXPECT_EQ(result["done"], 0);
  for (const nlohmann::json& cell : result["cells"]) EXPECT_EQ(cell["outcome"], "untestable");
  const Ended shown = Assay({"sweep", "show", folder_ / "a.sqlite"});
  EXPECT_THAT(shown.out, AllOf(HasSubstr("2 actions, cannot be tested"), HasSubstr("cell 1: ")));
}

TEST_F(SweepVerb, AWrongFileIsAnError) {
  folder_.Write("wrong.yaml", "format: assay-sweep/1\nscenarios: [known.yaml]\ntrails: 3\n");
  const Ended ended = Assay({"sweep", folder_ / "wrong.yaml", "--db", folder_ / "a.sqlite"});
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("wrong.yaml:3:1"), HasSubstr("trials")));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "a.sqlite"));
}

TEST_F(SweepVerb, WrongDatabasesAreErrors) {
  const std::string text = folder_.Write("text.sqlite", std::string(5000, 'x'));
  EXPECT_EQ(Assay({"sweep", "show", text}).code, 3);
  EXPECT_EQ(Assay({"sweep", "show", folder_ / "nothing.sqlite"}).code, 3);
  EXPECT_EQ(Assay({"sweep", "merge", folder_ / "out.sqlite", text}).code, 3);
  EXPECT_EQ(Assay({"replay", text, "1"}).code, 3);
  EXPECT_EQ(Sweep("text.sqlite", {"--resume"}).code, 3);
  EXPECT_EQ(Sweep("no/folder.sqlite", {}).code, 4);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out.sqlite"));
}

TEST_F(SweepVerb, IsOnADisk) {
  const Ended ended = Sweep(":memory:", {});
  EXPECT_EQ(Assay(WithModels({"sweep", sweep_, "--db", ":memory:"})).code, 2);
  EXPECT_EQ(ended.code, 0) << "a file of that name in a folder is one: " << ended.err;
}

// A line break in a comment of the script would begin a command.
TEST_F(SweepVerb, ScriptsHaveNoStrangeNames) {
  for (const char* name : {"a\nrm -rf x", "a\x1b[31m", "a\xff"}) {
    const std::string sweep = folder_.Write(name, TextOf(sweep_));
    const Ended ended = Assay(WithModels({"sweep", "slurm", sweep}));
    EXPECT_EQ(ended.code, 2) << ended.out;
    EXPECT_EQ(ended.out, "");
    EXPECT_THAT(ended.err, HasSubstr("cannot stand in a script"));
  }
}

TEST_F(SweepVerb, NeedsNoStreams) {
  for (const char* streams : {">/dev/null 2>&-", ">/dev/null 2>/dev/full", "<&- >&- 2>&-"}) {
    const std::string database = folder_ / "streams.sqlite";
    const std::string line =
        fmt::format("'{}' sweep '{}' --db '{}' --models '{}' {}", ASSAY_PROGRAM, sweep_, database,
                    (kTree / "models").string(), streams);
    cli::Run("/bin/sh", {"-c", line});
    const nlohmann::json shown = Assay({"sweep", "show", database, "--json"}).Json();
    EXPECT_EQ(shown["done"], shown["trials"]) << streams;
    std::filesystem::remove(database);
  }
}

TEST_F(SweepVerb, WrongSharesAreErrors) {
  for (const char* shard : {"0/2", "3/2", "1", "a/b", "1/0"}) {
    const Ended ended = Sweep("a.sqlite", {"--shard", shard});
    EXPECT_EQ(ended.code, 2) << shard;
    EXPECT_THAT(ended.err, HasSubstr("I/N"));
  }
  EXPECT_EQ(Assay({"sweep"}).code, 2);
}

TEST_F(SweepVerb, CheckTellsTheGrid) {
  const Ended ended = Assay(WithModels({"check", sweep_}));
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("2 trials in 2 cells, 1 plan"));
}

TEST_F(SweepVerb, SampleSweepsAreRight) {
  for (const auto& entry : std::filesystem::directory_iterator(kTree / "scenarios/sweeps")) {
    if (entry.path().extension() != ".yaml") continue;
    EXPECT_EQ(Assay({"check", entry.path()}).code, 0) << entry.path();
  }
}

TEST_F(SweepVerb, InterruptedItTellsHowToGoOn) {
  Write(1'000'000);
  const std::string models = (kTree / "models").string();
  const std::string database = folder_ / "a.sqlite";
  const std::string err = folder_ / "err";
  const pid_t child = fork();
  if (child == 0) {
    if (freopen(err.c_str(), "w", stderr) == nullptr) _exit(126);
    execl(ASSAY_PROGRAM, ASSAY_PROGRAM, "sweep", sweep_.c_str(), "--db", database.c_str(),
          "--models", models.c_str(), nullptr);
    _exit(127);
  }
  // Waits until the sweep has begun.
  for (int i = 0; i < 200 && !std::filesystem::exists(database); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  kill(child, SIGTERM);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 143);
  EXPECT_THAT(TextOf(err), HasSubstr("--resume goes on"));
  EXPECT_EQ(Assay({"sweep", "show", database}).code, 0);
}

// Returns the commands in the script's comments, with the script's path instead of THIS-SCRIPT.
std::string Instructions(const std::string& script, const std::string& path) {
  std::string commands;
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#   ")) {
      commands += std::regex_replace(line.substr(4), std::regex("THIS-SCRIPT"), path) + "\n";
    }
  }
  return commands;
}

TEST_F(SweepVerb, SlurmDoesItInShards) {
  const SlurmCluster slurm;
  if (!slurm.trouble().empty()) GTEST_SKIP() << slurm.trouble();
  const Ended ended =
      Assay(WithModels({"sweep", "slurm", sweep_, "--db", folder_ / "all.sqlite", "--tasks", "2"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const std::string script = folder_.Write("job.sh", ended.out);
  const std::string submitted =
      slurm.Shell(Instructions(ended.out, script), std::filesystem::path(script).parent_path());
  for (int i = 0; i < 600 && !std::filesystem::exists(folder_ / "all.sqlite"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  ASSERT_TRUE(std::filesystem::exists(folder_ / "all.sqlite"))
      << submitted << slurm.Shell("squeue; cat slurm-*.out", folder_ / ".");
  const nlohmann::json shown = Assay({"sweep", "show", folder_ / "all.sqlite", "--json"}).Json();
  EXPECT_EQ(shown["done"], 2);
  EXPECT_EQ(shown["trials"], 2);
}

}  // namespace
}  // namespace assay::cli::sweep_test
