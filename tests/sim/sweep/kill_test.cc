#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "planner/base/input_files/input_error.h"
#include "planner/base/random.h"
#include "sim/sweep/runner/runner.h"
#include "tests/sim/sweep/false_work.h"
#include "tests/sim/sweep/sweep_folder.h"
#include "tests/sim/sweep/tables.h"

namespace assay::sweep::kill_test {
namespace {

namespace fs = std::filesystem;

// Runs sweeps in processes that are ended in the middle.
class BrokenOff : public SweepFolder {
 protected:
  BrokenOff()
      : sweep_(Read("scenarios: [a.yaml, b.yaml]\nnoise: [none, attack, uniform]\nseeds: [1, 2]\n"
                    "trials: 100\n")),
        facts_(FactsOf(sweep_, "1")) {}

  void RunInto(const fs::path& file, const RunOptions& options) const {
    Store store = Store::Resume(file, facts_);
    Work work = FalseWork();
    work.run = [](const PlannedCell& cell, int number) {
      std::this_thread::sleep_for(std::chrono::microseconds(300));
      return FalseTrial(cell, number);
    };
    work.falsification = [](const PlannedCell& cell, const FalsificationControl& control) {
      std::this_thread::sleep_for(std::chrono::milliseconds(3));
      return MadeUpFalsification(cell, control);
    };
    RunSweep(sweep_, work, store, options);
    store.Close();
  }

  // Starts a process that calls `what` and returns its id. The process exits with 0, or with 1 on
  // an error.
  static pid_t Start(const std::function<void()>& what) {
    const pid_t child = fork();
    if (child != 0) return child;
    try {
      what();
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}\n", error.what());
      _exit(1);
    }
    _exit(0);
  }
  static int StatusOf(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return status;
  }

  const Sweep sweep_;
  const SweepFacts facts_;
};

TEST_F(BrokenOff, KilledAtAnyMomentItGoesOnToTheSameTables) {
  RunInto(folder_ / "whole.sqlite", {});
  RandomStream random(4, "kill");
  const fs::path file = folder_ / "killed.sqlite";
  int kills = 0;
  for (int start = 0; start < 200; ++start) {
    const pid_t child = Start([&] { RunInto(file, {.jobs = 2, .batch = 8}); });
    std::this_thread::sleep_for(std::chrono::microseconds(random.Index(20'000)));
    kill(child, SIGKILL);
    const int status = StatusOf(child);
    if (WIFEXITED(status)) {
      EXPECT_EQ(WEXITSTATUS(status), 0);
      break;
    }
    ++kills;
  }
  EXPECT_GE(kills, 3);
  RunInto(file, {});
  EXPECT_EQ(Tables(file), Tables(folder_ / "whole.sqlite"));
}

// A limit on the file size stands for a full disk, because not every machine allows a small disk.
TEST_F(BrokenOff, WithoutRoomItKeepsWhatItHas) {
  RunInto(folder_ / "whole.sqlite", {});
  const fs::path file = folder_ / "limited.sqlite";
  const pid_t child = Start([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{400'000, 400'000};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      RunInto(file, {.jobs = 2, .batch = 8});
    } catch (const EnvironmentError& error) {
      if (std::string(error.what()).find("limited.sqlite") != std::string::npos) _exit(4);
    }
  });
  const int status = StatusOf(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 4);
  EXPECT_GE(Store::Open(file).Trials().size(), 8u);
  RunInto(file, {});
  EXPECT_EQ(Tables(file), Tables(folder_ / "whole.sqlite"));
}

// The disk is mounted in a namespace of the process, so that nothing stays mounted. The process
// exits with 77 where that is not allowed.
TEST_F(BrokenOff, AFullDiskIsToldAndLosesNothing) {
  const fs::path disk = folder_ / "disk";
  fs::create_directories(disk);
  const pid_t child = Start([&] {
    if (unshare(CLONE_NEWNS) != 0 ||
        mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("none", disk.c_str(), "tmpfs", 0, "size=400k") != 0) {
      _exit(77);
    }
    try {
      RunInto(disk / "full.sqlite", {.jobs = 2, .batch = 8});
      _exit(5);  // the disk was not full
    } catch (const EnvironmentError& error) {
      const std::string what = error.what();
      if (what.find("full.sqlite") == std::string::npos) _exit(6);
      if (what.find("room") == std::string::npos) _exit(7);
    }
    if (mount("none", disk.c_str(), nullptr, MS_REMOUNT, "size=8m") != 0) _exit(77);
    if (Store::Open(disk / "full.sqlite").Trials().size() < 8) _exit(8);
    RunInto(disk / "full.sqlite", {});
    fs::copy_file(disk / "full.sqlite", disk / "copy.sqlite");
    if (mount("none", disk.c_str(), nullptr, MS_REMOUNT | MS_RDONLY, "size=8m") != 0) _exit(77);
    try {
      Store::Resume(disk / "full.sqlite", facts_);
      _exit(9);  // the disk was not read-only
    } catch (const EnvironmentError& error) {
      if (std::string(error.what()).find("read-only") == std::string::npos) _exit(10);
    }
    RunInto(folder_ / "whole.sqlite", {});
    if (Tables(disk / "full.sqlite") != Tables(folder_ / "whole.sqlite")) _exit(11);
  });
  const int status = StatusOf(child);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "mounting a small disk is not permitted";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace assay::sweep::kill_test
