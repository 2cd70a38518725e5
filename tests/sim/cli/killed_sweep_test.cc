#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

#include "tests/sim/cli/program.h"

namespace assay::cli::killed_sweep_test {
namespace {

using ::testing::HasSubstr;

// Returns how often the real program is killed. The environment variable ASSAY_KILLS sets it. With
// more than 3 kills, the sweep contains falsification, too.
int Kills() {
  const char* const wanted = std::getenv("ASSAY_KILLS");
  return wanted == nullptr ? 3 : std::atoi(wanted);
}
const char* Grid() {
  return Kills() > 3 ? "noise: [none, uniform, attack]\nerror_scales: [1, 0.5]\ntrials: 6\n"
                       "attempts: 10\n"
                     : "noise: [none, uniform]\ntrials: 2\n";
}

// A sweep of the scenario `s.yaml`, with real trials.
class KilledSweep : public ::testing::Test {
 protected:
  KilledSweep() {
    std::filesystem::copy(kTwoActions, folder_ / "s.yaml");
    folder_.Write("sweep.yaml",
                  std::string("format: assay-sweep/1\nscenarios: [s.yaml]\n") + Grid());
  }

  std::vector<std::string> Command(const std::string& database) const {
    return {
        "sweep",    folder_ / "sweep.yaml", "--db", folder_ / database, "--jobs", "2", "--resume",
        "--models", kTree / "models"};
  }
  int DoneIn(const std::string& database) const {
    const Ended shown = Assay({"sweep", "show", folder_ / database, "--json"});
    return shown.code == 0 ? shown.Json()["done"].get<int>() : 0;
  }
  // Expects both databases to have the same rows. Merging refuses rows that contradict each other,
  // and it adds the rows that only one of them has.
  void ExpectEqual(const std::string& a, const std::string& b) const {
    for (const auto& [first, second] : {std::pair(a, b), std::pair(b, a)}) {
      const std::string merged = folder_ / ("merged-" + first);
      const Ended ended = Assay({"sweep", "merge", merged, folder_ / first, folder_ / second});
      EXPECT_EQ(ended.code, 0) << ended.err;
      EXPECT_EQ(DoneIn("merged-" + first), DoneIn(first));
      std::filesystem::remove(merged);
    }
  }

  const Folder folder_;
};

TEST_F(KilledSweep, GoesOnToTheSameTables) {
  Assay(Command("first.sqlite"));  // measures the noise floor, which is kept
  const auto start = std::chrono::steady_clock::now();
  Assay(Command("whole.sqlite"));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  std::mt19937_64 random(7);
  int after_trials = 0;
  for (int kill = 1; kill <= Kills(); ++kill) {
    Running running(Command("killed.sqlite"));
    const double share = static_cast<double>(random()) / static_cast<double>(random.max());
    std::this_thread::sleep_for(taken * (0.1 + 0.8 * share));
    running.Signal(SIGKILL);
    const Ended ended = running.Wait();
    if (DoneIn("killed.sqlite") > 0) ++after_trials;
    if (ended.code != -SIGKILL) std::filesystem::remove(folder_ / "killed.sqlite");
  }
  const Ended ended = Assay(Command("killed.sqlite"));
  EXPECT_TRUE(ended.code == 0 || ended.code == 12) << ended.err;
  EXPECT_EQ(DoneIn("killed.sqlite"), DoneIn("whole.sqlite"));
  ExpectEqual("killed.sqlite", "first.sqlite");
  RecordProperty("killed after trials were stored", after_trials);
}

// The second program reports the lock, and the first one loses nothing.
TEST_F(KilledSweep, TwoAtOnceOnOneDatabase) {
  Running first(Command("two.sqlite"));
  while (!std::filesystem::exists(folder_ / "two.sqlite")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  const Ended second = Assay(Command("two.sqlite"));
  EXPECT_EQ(second.code, 4) << second.err;
  EXPECT_THAT(second.err, HasSubstr("locked by another program; wait until that has ended"));
  const Ended ended = first.Wait();
  EXPECT_TRUE(ended.code == 0 || ended.code == 12) << ended.err;
  Assay(Command("whole.sqlite"));
  EXPECT_EQ(DoneIn("two.sqlite"), DoneIn("whole.sqlite"));
  ExpectEqual("two.sqlite", "whole.sqlite");
}

}  // namespace
}  // namespace assay::cli::killed_sweep_test
