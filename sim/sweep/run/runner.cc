#include "sim/sweep/run/runner.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_for_each.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <optional>

#include "sim/sweep/run/clock.h"

namespace assay::sweep {
namespace {

// The number of results per thread that may wait for an earlier trial that takes longer.
constexpr int kWaitingPerThread = 8;

// Collects results and writes them in batches. Only one thread may use it at a time.
class BatchWriter {
 public:
  BatchWriter(Store& store, const RunOptions& options) : store_(store), options_(options) {}

  void Add(TimedTrial trial) {
    batch_.push_back(std::move(trial));
    if (std::ssize(batch_) >= options_.batch || SecondsSince(written_) > options_.batch_seconds) {
      Write();
    }
  }

  void Write() {
    // The batch is emptied first, so that a failed batch is not written again.
    const std::vector<TimedTrial> batch = std::exchange(batch_, {});
    store_.Add(batch);
    done_ += static_cast<int>(batch.size());
    written_ = Clock::now();
  }

  int done() const { return done_; }

 private:
  Store& store_;
  const RunOptions& options_;
  std::vector<TimedTrial> batch_;
  int done_ = 0;
  Clock::time_point written_ = Clock::now();
};

// Returns the plan of another cell for this cell.
PlannedCell ForCell(PlannedCell planned, const Cell& cell) {
  planned.cell = cell;
  planned.record.cell = cell.number;
  planned.record.noise = Name(cell.noise);
  planned.record.sensing = Name(cell.sensing);
  planned.record.seed = static_cast<std::int64_t>(cell.seed);
  planned.record.trials = cell.trials;
  return planned;
}

// The exception by which the progress callback ends a falsification.
struct BreakOff {};

class Running {
 public:
  Running(const Sweep& sweep, const Work& work, Store& store, const RunOptions& options)
      : work_(work),
        store_(store),
        options_(options),
        cells_(Cells(sweep)),
        attempts_(sweep.attempts) {}

  RunEnd Execute() {
    FindTrialsToDo();
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, options_.jobs);
    tbb::task_arena arena(options_.jobs);
    arena.execute([&] { MakePlans(); });
    std::erase_if(to_do_, [&](int trial) { return !HasPlan(trial); });
    const auto attacks = std::ranges::stable_partition(
        to_do_, [&](int trial) { return CellOf(trial).noise != NoiseKind::kAttack; });
    attacks_.assign(attacks.begin(), attacks.end());
    to_do_.erase(attacks.begin(), attacks.end());
    advance_.trials = static_cast<int>(to_do_.size());
    advance_.attempts = attempts_ * std::ssize(attacks_);
    Tell();
    BatchWriter writer(store_, options_);
    arena.execute([&] { RunTrials(writer); });
    throughput_.trials = writer.done();
    arena.execute([&] { RunAttacks(writer); });
    const int left = static_cast<int>(to_do_.size() + attacks_.size()) - writer.done();
    return {.done = writer.done(),
            .before = before_,
            .left = left,
            .stopped = stopped_,
            .throughput = throughput_};
  }

 private:
  void FindTrialsToDo() {
    const std::vector<int> done = store_.Trials();
    for (int trial = 1; trial <= TrialCount(cells_); ++trial) {
      if (!options_.shard.Has(CellOf(trial), trial)) continue;
      if (std::ranges::binary_search(done, trial)) {
        ++before_;
      } else {
        to_do_.push_back(trial);
      }
    }
  }

  const Cell& CellOf(int trial) const { return cells_[PlaceOf(cells_, trial).cell]; }

  bool Stops() {
    stopped_ = stopped_ || (options_.stop && options_.stop());
    return stopped_;
  }

  void Tell() const {
    if (options_.tell) options_.tell(advance_);
  }

  // ---- plans

  // Returns the indices of the cells that have trials to do, in groups that share a plan.
  std::vector<std::vector<std::size_t>> CellsByPlan() const {
    std::vector<std::vector<std::size_t>> groups;
    std::vector<bool> needed(cells_.size());
    for (const int trial : to_do_) needed[PlaceOf(cells_, trial).cell] = true;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (!needed[i]) continue;
      const auto group = std::ranges::find_if(groups, [&](const auto& members) {
        return SharePlan(cells_[members.front()], cells_[i]);
      });
      if (group == groups.end()) {
        groups.push_back({i});
      } else {
        group->push_back(i);
      }
    }
    return groups;
  }

  void MakePlans() {
    planned_.resize(cells_.size());
    for (CellRecord& record : store_.Cells()) stored_.emplace(record.cell, std::move(record));
    const std::vector<std::vector<std::size_t>> groups = CellsByPlan();
    for (const auto& group : groups) advance_.cells += static_cast<int>(group.size());
    Tell();
    tbb::parallel_for_each(groups, [&](const std::vector<std::size_t>& group) {
      {
        const std::lock_guard lock(mutex_);
        if (Stops()) return;
      }
      PlanGroup(group);
    });
  }

  // Makes one plan for all cells of the group. If the plan of one of them is stored, that plan is
  // restored.
  void PlanGroup(const std::vector<std::size_t>& group) {
    const Clock::time_point start = Clock::now();
    const auto stored = std::ranges::find_if(
        group, [&](std::size_t i) { return stored_.contains(cells_[i].number); });
    const PlannedCell planned =
        stored == group.end() ? work_.plan(cells_[group.front()])
                              : work_.restore(cells_[*stored], stored_.at(cells_[*stored].number));
    const double seconds = SecondsSince(start);
    const std::lock_guard lock(mutex_);
    std::vector<CellRecord> added;
    for (const std::size_t i : group) {
      planned_[i] = ForCell(planned, cells_[i]);
      if (!stored_.contains(cells_[i].number)) added.push_back(planned_[i].record);
      ++advance_.cells_planned;
    }
    store_.Add(added, seconds);
    Tell();
  }

  bool HasPlan(int trial) const {
    const std::string& outcome = planned_[PlaceOf(cells_, trial).cell].record.outcome;
    // The outcome is empty if the run was stopped before the cell was planned.
    return outcome.empty() || outcome == "planned";
  }

  // ---- trials

  TimedTrial RunTrial(int trial) const {
    const TrialPlace place = PlaceOf(cells_, trial);
    TimedTrial timed = work_.run(planned_[place.cell], place.number);
    SetNumbers(trial, timed.record);
    return timed;
  }

  void SetNumbers(int trial, TrialRecord& record) const {
    const TrialPlace place = PlaceOf(cells_, trial);
    record.trial = trial;
    record.cell = cells_[place.cell].number;
    record.number = place.number;
  }

  void RunTrials(BatchWriter& writer) {
    const Clock::time_point start = Clock::now();
    std::size_t next = 0;
    const auto hand_out = [&](tbb::flow_control& control) {
      if (next < to_do_.size() && !Stops()) return to_do_[next++];
      control.stop();
      return 0;
    };
    const auto keep = [&](TimedTrial timed) {
      throughput_.steps += timed.record.steps;
      writer.Add(std::move(timed));
      ++advance_.trials_done;
      advance_.seconds = SecondsSince(start);
      Tell();
    };
    try {
      tbb::parallel_pipeline(
          static_cast<std::size_t>(kWaitingPerThread) * options_.jobs,
          tbb::make_filter<void, int>(tbb::filter_mode::serial_in_order, hand_out) &
              tbb::make_filter<int, TimedTrial>(tbb::filter_mode::parallel,
                                                [&](int trial) { return RunTrial(trial); }) &
              tbb::make_filter<TimedTrial, void>(tbb::filter_mode::serial_in_order, keep));
    } catch (...) {
      writer.Write();
      throw;
    }
    writer.Write();
    throughput_.seconds = SecondsSince(start);
  }

  // ---- falsifications

  // The falsifications share the threads: a thread that finds no new one to begin helps with
  // another one. After an error the others are broken off by their progress callbacks. TBB must not
  // cancel their tasks, because they would take their partial results for complete ones.
  void RunAttacks(BatchWriter& writer) {
    attacks_started_ = Clock::now();
    const auto run = [&](std::size_t i) {
      try {
        std::optional<TimedTrial> timed = AttackUnlessStopped(attacks_[i]);
        if (!timed) return;
        const std::lock_guard lock(mutex_);
        writer.Add(std::move(*timed));
        writer.Write();
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
    };
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, attacks_.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) run(i);
        },
        tbb::simple_partitioner());
    if (error_) std::rethrow_exception(error_);
  }

  // Returns none if the falsification was broken off.
  std::optional<TimedTrial> AttackUnlessStopped(int trial) {
    {
      const std::lock_guard lock(mutex_);
      if (BreaksOff()) return std::nullopt;
    }
    std::int64_t made = 0;
    const auto progress = [&](std::int64_t attempts) {
      const std::lock_guard lock(mutex_);
      advance_.attempts_made += std::max(attempts, made) - made;
      made = std::max(attempts, made);
      advance_.attack_seconds = SecondsSince(attacks_started_);
      Tell();
      if (BreaksOff()) throw BreakOff();
    };
    try {
      const PlannedCell& planned = planned_[PlaceOf(cells_, trial).cell];
      TimedTrial timed = work_.attack(planned, {.jobs = options_.jobs, .progress = progress});
      SetNumbers(trial, timed.record);
      return timed;
    } catch (...) {
      // The exception may be another one than BreakOff, because NLopt throws its own.
      const std::lock_guard lock(mutex_);
      if (BreaksOff()) return std::nullopt;
      throw;
    }
  }

  bool BreaksOff() { return error_ != nullptr || Stops(); }

  const Work& work_;
  Store& store_;
  const RunOptions& options_;
  const std::vector<Cell> cells_;
  const std::int64_t attempts_;  // attempts of each falsification
  std::vector<int> to_do_;       // trials; without falsifications once all plans are made
  std::vector<int> attacks_;     // trials that are falsifications
  int before_ = 0;
  std::map<int, CellRecord> stored_;  // by number of the cell
  std::vector<PlannedCell> planned_;  // by index of the cell
  // Guards the store, the advance and the reasons to end, while plans and falsifications are made.
  std::mutex mutex_;
  Advance advance_;
  Throughput throughput_;
  Clock::time_point attacks_started_;
  std::exception_ptr error_;  // the first error of a falsification
  bool stopped_ = false;
};

}  // namespace

RunEnd RunSweep(const Sweep& sweep, const Work& work, Store& store, const RunOptions& options) {
  return Running(sweep, work, store, options).Execute();
}

}  // namespace assay::sweep
