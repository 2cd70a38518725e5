#include "sim/sweep/runner/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>

#include "planner/base/input_files/input_error.h"
#include "sim/sweep/database/merge.h"
#include "sim/sweep/database/summary.h"
#include "tests/sim/sweep/false_work.h"
#include "tests/sim/sweep/sweep_folder.h"
#include "tests/sim/sweep/tables.h"

namespace assay::sweep::runner_test {
namespace {

namespace fs = std::filesystem;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class Runner : public SweepFolder {
 protected:
  Runner()
      : sweep_(Read("scenarios: [a.yaml, b.yaml]\nerror_scales: [1, 0.1]\n"
                    "noise: [none, attack, uniform]\nseeds: [1, 2]\ntrials: 40\ncontrol_trials: 3\n"
                    "attempts: 25\n")),
        facts_(FactsOf(sweep_, "1")),
        trials_(TrialCount(Cells(sweep_))) {}

  // Runs the sweep into a database with this name. A database with trials is continued.
  RunEnd RunInto(const std::string& name, const RunOptions& options,
                 const Work& work = FalseWork()) const {
    Store store = Store::Resume(folder_ / name, facts_);
    const RunEnd end = RunSweep(sweep_, work, store, options);
    store.Close();
    return end;
  }
  auto TablesOf(const std::string& name) const { return Tables(folder_ / name); }

  const Sweep sweep_;
  const SweepFacts facts_;
  const int trials_;
};

TEST_F(Runner, DoesEveryTrialOnce) {
  std::mutex mutex;
  std::multiset<std::pair<int, int>> seen;
  Work work = FalseWork();
  work.run = [&](const PlannedCell& cell, int number) {
    const std::lock_guard lock(mutex);
    seen.insert({cell.cell.number, number});
    return FalseTrial(cell, number);
  };
  work.falsification = [&](const PlannedCell& cell, const FalsificationControl& control) {
    {
      const std::lock_guard lock(mutex);
      seen.insert({cell.cell.number, 1});
    }
    return MadeUpFalsification(cell, control);
  };
  const RunEnd end = RunInto("a.sqlite", {.jobs = 2}, work);
  EXPECT_EQ(end.done, trials_);
  EXPECT_EQ(end.left, 0);
  EXPECT_FALSE(end.stopped);
  EXPECT_EQ(static_cast<int>(seen.size()), trials_);
  EXPECT_EQ(static_cast<int>(std::set(seen.begin(), seen.end()).size()), trials_);
  EXPECT_EQ(static_cast<int>(TablesOf("a.sqlite")["trial"].size()), trials_);
}

TEST_F(Runner, WritesTheSameTablesForAnyNumberOfThreadsAndBatches) {
  RunInto("one.sqlite", {.jobs = 1});
  RunInto("two.sqlite", {.jobs = 2});
  RunInto("seven.sqlite", {.jobs = 7, .batch = 1});
  const auto tables = TablesOf("one.sqlite");
  for (const auto& [name, rows] : tables) EXPECT_FALSE(rows.empty()) << name;
  EXPECT_EQ(tables, TablesOf("two.sqlite"));
  EXPECT_EQ(tables, TablesOf("seven.sqlite"));
}

TEST_F(Runner, ShardsMergeToTheSameTables) {
  RunInto("whole.sqlite", {});
  for (const int count : {1, 2, 5}) {
    std::vector<fs::path> parts;
    for (int i = count; i >= 1; --i) {
      parts.push_back(folder_ / fmt::format("{}-of-{}.sqlite", i, count));
      RunInto(parts.back().filename(), {.jobs = 2, .shard = {i, count}});
    }
    const std::string merged = fmt::format("merged-{}.sqlite", count);
    Merge(folder_ / merged, parts);
    EXPECT_EQ(TablesOf(merged), TablesOf("whole.sqlite"));
  }
}

TEST_F(Runner, MergedShardsCanBeGoneOnWith) {
  RunInto("whole.sqlite", {});
  RunInto("1.sqlite", {.shard = {1, 3}});
  RunInto("3.sqlite", {.shard = {3, 3}});
  Merge(folder_ / "merged.sqlite", {folder_ / "1.sqlite", folder_ / "3.sqlite"});
  const RunEnd end = RunInto("merged.sqlite", {});
  EXPECT_EQ(end.before + end.done, trials_);
  EXPECT_EQ(TablesOf("merged.sqlite"), TablesOf("whole.sqlite"));
}

TEST_F(Runner, MergingTakesWhatIsInSeveralOnce) {
  RunInto("whole.sqlite", {});
  RunInto("half.sqlite", {.shard = {1, 2}});
  Merge(folder_ / "merged.sqlite", {folder_ / "half.sqlite", folder_ / "whole.sqlite"});
  EXPECT_EQ(TablesOf("merged.sqlite"), TablesOf("whole.sqlite"));
}

TEST_F(Runner, MergingRefusesContradictionsAndOtherSweeps) {
  RunInto("a.sqlite", {});
  Work liar = FalseWork();
  liar.run = [](const PlannedCell& cell, int number) {
    TimedTrial trial = FalseTrial(cell, number);
    trial.record.simulated += 1;
    return trial;
  };
  RunInto("b.sqlite", {}, liar);
  EXPECT_THROW(Merge(folder_ / "c.sqlite", {folder_ / "a.sqlite", folder_ / "b.sqlite"}),
               InputError);
  Store::Create(folder_ / "other.sqlite", FactsOf(sweep_, "2"));
  EXPECT_THROW(Merge(folder_ / "d.sqlite", {folder_ / "a.sqlite", folder_ / "other.sqlite"}),
               InputError);
}

TEST_F(Runner, GoesOnWhereItWasStopped) {
  RunInto("whole.sqlite", {});
  std::atomic<int> asked = 0;
  int before = 0;
  for (int start = 0; start < 20; ++start) {
    const RunEnd end =
        RunInto("stopped.sqlite", {.jobs = 2, .stop = [&] { return ++asked % 50 == 0; }});
    EXPECT_EQ(end.before, before);
    EXPECT_EQ(end.stopped, end.left > 0);
    before += end.done;
    if (!end.stopped) break;
  }
  EXPECT_EQ(before, trials_);
  EXPECT_EQ(TablesOf("stopped.sqlite"), TablesOf("whole.sqlite"));
}

TEST_F(Runner, MakesOnePlanForCellsThatDifferInNoise) {
  std::atomic<int> plans = 0;
  Work work = FalseWork();
  work.plan = [&](const Cell& cell) {
    ++plans;
    return FalseWork().plan(cell);
  };
  RunInto("a.sqlite", {.jobs = 2}, work);
  EXPECT_EQ(plans, 4);
  RunInto("a.sqlite", {.jobs = 2}, work);
  EXPECT_EQ(plans, 4);
}

TEST_F(Runner, CellsWithoutAPlanHaveNoTrials) {
  Work work = FalseWork();
  work.plan = [&](const Cell& cell) {
    PlannedCell planned = FalseWork().plan(cell);
    if (cell.scenario == "b.yaml") {
      planned.record.outcome = "none";
      planned.record.conflict = "reach";
    }
    return planned;
  };
  const RunEnd end = RunInto("a.sqlite", {.jobs = 2}, work);
  EXPECT_EQ(end.done, trials_ / 2);
  EXPECT_EQ(end.left, 0);
  const RunEnd again = RunInto("a.sqlite", {.jobs = 2}, work);
  EXPECT_EQ(again.done, 0);
  EXPECT_EQ(again.left, 0);
}

TEST_F(Runner, WhatWasDoneBeforeAnErrorIsKept) {
  Work work = FalseWork();
  work.run = [](const PlannedCell& cell, int number) {
    if (cell.cell.number == 5 && number == 3) throw EnvironmentError("no renderer");
    return FalseTrial(cell, number);
  };
  EXPECT_THROW(RunInto("a.sqlite", {.jobs = 1, .batch_seconds = 100}, work), EnvironmentError);
  RunInto("whole.sqlite", {});
  EXPECT_EQ(TablesOf("a.sqlite")["trial"].size(), 8u);  // 3 + 3 of the control arm, then two more
  RunInto("a.sqlite", {});
  EXPECT_EQ(TablesOf("a.sqlite"), TablesOf("whole.sqlite"));
}

TEST_F(Runner, TellsHowFarItIs) {
  std::mutex mutex;
  std::vector<Advance> advances;
  RunInto("a.sqlite", {.jobs = 2, .tell = [&](const Advance& advance) {
                         const std::lock_guard lock(mutex);
                         advances.push_back(advance);
                       }});
  constexpr int kFalsifications = 8;
  EXPECT_EQ(advances.back().trials_done, trials_ - kFalsifications);
  EXPECT_EQ(advances.back().trials, trials_ - kFalsifications);
  EXPECT_EQ(advances.back().cells_planned, 24);
  EXPECT_EQ(advances.back().attempts_made, kFalsifications * kFalseAttempts);
  EXPECT_EQ(advances.back().attempts, kFalsifications * kFalseAttempts);
}

TEST_F(Runner, FalsificationsMayUseAllThreadsAndComeLast) {
  std::mutex mutex;
  int trials = 0;
  Work work = FalseWork();
  work.run = [&](const PlannedCell& cell, int number) {
    const std::lock_guard lock(mutex);
    ++trials;
    return FalseTrial(cell, number);
  };
  work.falsification = [&](const PlannedCell& cell, const FalsificationControl& control) {
    const std::lock_guard lock(mutex);
    EXPECT_EQ(trials, trials_ - 8);
    EXPECT_EQ(control.jobs, 3);
    return MadeUpFalsification(cell, {});
  };
  RunInto("a.sqlite", {.jobs = 3}, work);
}

// A falsification is stored when it is done. One that was broken off is not stored.
TEST_F(Runner, FalsificationsAreStoppedInTheMiddle) {
  RunInto("whole.sqlite", {});
  int before = 0;
  for (int start = 0; start < 100; ++start) {
    std::atomic<int> attempts = 0;
    const RunEnd end = RunInto(
        "stopped.sqlite",
        {.jobs = 2,
         .stop = [&] { return attempts > 2 * kFalseAttempts; },
         .tell =
             [&](const Advance& advance) { attempts = static_cast<int>(advance.attempts_made); }});
    EXPECT_EQ(end.before, before);
    before += end.done;
    const auto tables = TablesOf("stopped.sqlite");
    const auto falsifications = tables.find("attack");
    EXPECT_EQ(end.left,
              8 - (falsifications == tables.end() ? 0 : std::ssize(falsifications->second)));
    if (!end.stopped) break;
    EXPECT_GT(end.left, 0);
  }
  EXPECT_EQ(before, trials_);
  EXPECT_EQ(TablesOf("stopped.sqlite"), TablesOf("whole.sqlite"));
}

TEST_F(Runner, AnErrorInAFalsificationLeavesTheOthersWhole) {
  RunInto("whole.sqlite", {});
  Work work = FalseWork();
  work.falsification = [](const PlannedCell& cell, const FalsificationControl& control) {
    TimedTrial timed = MadeUpFalsification(cell, control);
    if (cell.cell.falsification == 3) throw EnvironmentError("no room");
    return timed;
  };
  EXPECT_THROW(RunInto("a.sqlite", {.jobs = 2}, work), EnvironmentError);
  auto tables = TablesOf("a.sqlite");
  const auto whole = TablesOf("whole.sqlite");
  EXPECT_LT(tables["attack"].size(), 8u);
  for (const std::string& row : tables["attack"]) {
    EXPECT_THAT(whole.at("attack"), ::testing::Contains(row));
  }
  RunInto("a.sqlite", {.jobs = 2});
  EXPECT_EQ(TablesOf("a.sqlite"), whole);
}

TEST_F(Runner, MergingComparesFalsificationsButNotTheirCommands) {
  const auto falsification_with = [](auto&& change) {
    Work work = FalseWork();
    work.falsification = [change](const PlannedCell& cell, const FalsificationControl& control) {
      TimedTrial timed = MadeUpFalsification(cell, control);
      change(*timed.falsification);
      return timed;
    };
    return work;
  };
  RunInto("a.sqlite", {});
  RunInto("elsewhere.sqlite", {}, falsification_with([](FalsificationRecord& falsification) {
            for (auto& example : falsification.counterexamples)
              example.replay = "assay run ../x.yaml";
          }));
  RunInto("liar.sqlite", {}, falsification_with([](FalsificationRecord& falsification) {
            falsification.worst[0].margin += 1;
          }));
  Merge(folder_ / "merged.sqlite", {folder_ / "a.sqlite", folder_ / "elsewhere.sqlite"});
  EXPECT_EQ(TablesOf("merged.sqlite"), TablesOf("a.sqlite"));
  EXPECT_THROW(Merge(folder_ / "b.sqlite", {folder_ / "a.sqlite", folder_ / "liar.sqlite"}),
               InputError);
}

// The throughput counts trials only, and no falsifications.
TEST_F(Runner, TellsItsThroughput) {
  const RunEnd end = RunInto("a.sqlite", {.jobs = 2});
  const Store store = Store::Open(folder_ / "a.sqlite");
  EXPECT_EQ(end.throughput.trials, trials_ - 8);
  EXPECT_EQ(end.throughput.steps, store.database().Integer("SELECT sum(steps) FROM trial"));
  EXPECT_GT(end.throughput.seconds, 0);
  EXPECT_EQ(RunInto("a.sqlite", {}).throughput.steps, 0);
}

TEST_F(Runner, SummariesCountWhatTheTrialsSay) {
  RunInto("a.sqlite", {});
  const Store store = Store::Open(folder_ / "a.sqlite");
  const std::vector<CellSummary> summaries = Summarize(store);
  ASSERT_EQ(summaries.size(), 24u);
  int trial = 0;
  for (const CellSummary& summary : summaries) {
    CellSummary expected;
    for (int i = 0; i < summary.cell.trials; ++i) {
      const TrialRecord record = *store.FindTrial(++trial);
      ++expected.done;
      expected.succeeded += record.outcome == "succeeded";
      expected.certificates.contained += record.counts.contained;
      expected.certificates.violated += record.counts.violated;
      expected.certificates.not_claimed += record.counts.not_claimed;
      expected.with_errors += record.errors_signalled > 0;
      expected.operator_called += record.operator_called;
    }
    EXPECT_EQ(summary.done, expected.done);
    EXPECT_EQ(summary.succeeded, expected.succeeded);
    EXPECT_EQ(summary.certificates, expected.certificates);
    EXPECT_EQ(summary.with_errors, expected.with_errors);
    EXPECT_EQ(summary.operator_called, expected.operator_called);
    int failed = 0;
    for (const auto& [outcome, count] : summary.failed) failed += count;
    EXPECT_EQ(failed, expected.done - expected.succeeded);
  }
}

}  // namespace
}  // namespace assay::sweep::runner_test
