#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <thread>

#include "tests/sim/cli/program.h"

namespace assay::cli::interruption_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// This is much more than the second or two that are needed, for machines that are busy.
constexpr std::chrono::seconds kSoon{30};

// Ends a command that would run for ever by a signal. The signal is sent as soon as the program has
// a handler for it, and the program must end soon after it.
std::optional<Ended> Interrupted(const std::vector<std::string>& arguments, int signal) {
  Running running(arguments);
  for (int waits = 0; !running.Catches(signal); ++waits) {
    if (waits == 12'000) {
      ADD_FAILURE() << "its trials never began";
      return std::nullopt;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  running.Signal(signal);
  const auto from = std::chrono::steady_clock::now();
  const Ended ended = running.Wait();
  EXPECT_LT(std::chrono::steady_clock::now() - from, kSoon);
  return ended;
}

constexpr const char* kForEver = "100000000";

// While an object of this class lives, programs find no noise floor that was measured before.
class NoCache {
 public:
  explicit NoCache(const std::string& empty) {
    if (const char* cache = std::getenv(kName)) before_ = cache;
    setenv(kName, empty.c_str(), 1);
  }
  ~NoCache() { before_ ? setenv(kName, before_->c_str(), 1) : unsetenv(kName); }
  NoCache(const NoCache&) = delete;
  NoCache& operator=(const NoCache&) = delete;

 private:
  static constexpr const char* kName = "XDG_CACHE_HOME";
  std::optional<std::string> before_;
};

TEST(Interruption, OfARunKeepsItsTrials) {
  const Folder folder;
  const std::string out = folder / "out";
  Running running({"run", kTwoActions, "--trials", kForEver, "-o", out, "--json"});
  while (!std::filesystem::exists(out + "/trace-2.jsonl")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  running.Signal(SIGTERM);
  const Ended ended = running.Wait();
  EXPECT_EQ(ended.code, 143) << ended.err;
  EXPECT_THAT(SchemaErrors("sim/cli/verbs/run.schema.json", ended.Json()), IsEmpty());
  for (const nlohmann::json& result : {ended.Json(), JsonOf(out + "/result.json")}) {
    EXPECT_EQ(result["interrupted"], true);
    EXPECT_GE(result["trials"], 1);
    EXPECT_EQ(result["succeeded"], result["trials"]);
  }
}

// The noise floor of figure 13 takes seconds, so the signal comes while it is measured.
TEST(Interruption, OfTheNoiseFloorEndsAsInATrial) {
  for (const std::vector<std::string>& noise :
       {std::vector<std::string>{"uniform", "--trials"}, {"attack", "--attempts"}}) {
    const Folder folder;
    const std::string out = folder / "out";
    const NoCache no_cache(folder / "cache");
    const std::optional<Ended> ended =
        Interrupted({"run", kTree / "scenarios/spar-fig13.yaml", "-o", out, "--json", "--noise",
                     noise[0], noise[1], "7"},
                    SIGTERM);
    if (!ended) continue;
    EXPECT_EQ(ended->code, 143) << ended->err;
    EXPECT_THAT(SchemaErrors("sim/cli/verbs/run.schema.json", ended->Json()), IsEmpty());
    for (const nlohmann::json& result : {ended->Json(), JsonOf(out + "/result.json")}) {
      EXPECT_EQ(result["interrupted"], true);
      EXPECT_THAT(result["gate"], IsEmpty());
      EXPECT_EQ(result[noise[0] == "attack" ? "attempts" : "trials"], 0);
    }
  }
}

struct InterruptedVerb {
  const char* name;
  std::vector<std::string> arguments;
  const char* schema;
};

class OfTrials : public ::testing::TestWithParam<InterruptedVerb> {};

TEST_P(OfTrials, TellsWhatIsThere) {
  const auto& [name, arguments, schema] = GetParam();
  std::vector<std::string> as_json = arguments;
  as_json.emplace_back("--json");
  if (const std::optional<Ended> ended = Interrupted(as_json, SIGTERM)) {
    EXPECT_EQ(ended->code, 143) << ended->err;
    EXPECT_EQ(ended->Json()["interrupted"], true);
    EXPECT_THAT(SchemaErrors(schema, ended->Json()), IsEmpty());
  }
}

const std::string kMated = kTree / "scenarios/mate-square.yaml";
const std::string kCans = kTree / "scenarios/two-cans.yaml";

INSTANTIATE_TEST_SUITE_P(
    Verbs, OfTrials,
    ::testing::Values(
        InterruptedVerb{"noise",
                        {"run", kTwoActions, "--noise", "uniform", "--trials", kForEver},
                        "sim/cli/verbs/run.schema.json"},
        InterruptedVerb{"attack",
                        {"run", kTwoActions, "--noise", "attack", "--attempts", kForEver},
                        "sim/cli/verbs/run.schema.json"},
        InterruptedVerb{
            "mate", {"mate", kMated, "--trials", "100000"}, "sim/cli/verbs/mate.schema.json"},
        InterruptedVerb{"run",
                        {"run", kCans, "--trials", "100000"},
                        "sim/cli/verbs/contingent_run.schema.json"}),
    [](const auto& verb) { return std::string(verb.param.name); });

TEST(Interruption, OfACalibrationKeepsItsPlacements) {
  const std::optional<Ended> ended =
      Interrupted({"calibrate", kTwoLooks, "--trials", kForEver, "--json"}, SIGTERM);
  if (ended) {
    EXPECT_EQ(ended->code, 143) << ended->err;
    EXPECT_EQ(ended->Json()["interrupted"], true);
  }
}

TEST(Interruption, OfPicturesKeepsThoseThatWereTaken) {
  const Folder folder;
  const std::optional<Ended> ended =
      Interrupted({"render", kTwoActions, "-o", folder / "out", "--json"}, SIGTERM);
  if (ended) {
    EXPECT_EQ(ended->code, 143) << ended->err;
    EXPECT_EQ(ended->Json()["interrupted"], true);
    for (const std::string picture : ended->Json()["pictures"]) {
      EXPECT_TRUE(std::filesystem::exists(folder / "out/" + picture)) << picture;
    }
  }
}

TEST(Interruption, IsToldToPeople) {
  const std::optional<Ended> ended =
      Interrupted({"run", kTwoActions, "--noise", "uniform", "--trials", kForEver}, SIGINT);
  if (ended) {
    EXPECT_EQ(ended->code, 130) << ended->err;
    EXPECT_THAT(ended->out, HasSubstr(std::string(" of ") + kForEver + " trials were made\n"));
  }
}

// A hang-up of the terminal ends the program, unless nohup ignores the signal.
TEST(Interruption, ByAHangUpIsLikeTermination) {
  const std::optional<Ended> ended =
      Interrupted({"run", kTwoActions, "--noise", "uniform", "--trials", kForEver}, SIGHUP);
  if (ended) {
    EXPECT_EQ(ended->code, 143) << ended->err;
  }
}

// Planning for figure 15 takes long enough for the signal to come during it.
TEST(Interruption, OfASweepThatPlansIsAnsweredSoon) {
  const Folder folder;
  std::filesystem::copy(kTree / "scenarios/spar-fig15.yaml", folder / "s.yaml");
  const std::string sweep = folder.Write(
      "sweep.yaml",
      "format: assay-sweep/1\nscenarios: [s.yaml]\nnoise: [uniform]\ntrials: 1\nerror_scales: "
      "[1, 0.99, 0.98, 0.97, 0.96, 0.95, 0.94, 0.93, 0.92, 0.91, 0.9, 0.89, 0.88, 0.87]\n");
  const std::string database = folder / "a.sqlite";
  Running running({"sweep", sweep, "--db", database, "--jobs", "1", "--models", kTree / "models"});
  while (!std::filesystem::exists(database)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  running.Signal(SIGINT);
  const Ended ended = running.Wait();
  EXPECT_EQ(ended.code, 130) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("--resume goes on"));
  EXPECT_EQ(Assay({"sweep", "show", database}).code, 0);
}

}  // namespace
}  // namespace assay::cli::interruption_test
