#include "sim/sweep/runner/runner.h"

#include <algorithm>
#include <map>
#include <mutex>

#include "sim/execution/trial/scheduler.h"
#include "sim/sweep/runner/clock.h"

namespace assay::sweep {
namespace {

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

// Returns a plan that was made for another cell as the plan of this cell.
PlannedCell ForCell(PlannedCell planned, const Cell& cell) {
  planned.cell = cell;
  planned.record.cell = cell.number;
  planned.record.noise = Name(cell.noise);
  planned.record.sensing = Name(cell.sensing);
  planned.record.seed = static_cast<std::int64_t>(cell.seed);
  planned.record.trials = cell.trials;
  return planned;
}

class Running {
 public:
  Running(const Sweep& sweep, const Work& work, Store& store, const RunOptions& options)
      : work_(work),
        store_(store),
        options_(options),
        cells_(Cells(sweep)),
        attempts_(sweep.attempts),
        scheduler_(options.jobs, options.stop) {}

  RunEnd Execute() {
    FindTrialsToDo();
    MakePlans();
    std::erase_if(to_do_, [&](int trial) { return !HasPlan(trial); });
    const auto falsifications = std::ranges::stable_partition(
        to_do_, [&](int trial) { return CellOf(trial).noise != NoiseKind::kFalsification; });
    falsifications_.assign(falsifications.begin(), falsifications.end());
    to_do_.erase(falsifications.begin(), falsifications.end());
    advance_.trials = static_cast<int>(to_do_.size());
    advance_.attempts = attempts_ * std::ssize(falsifications_);
    Tell();
    BatchWriter writer(store_, options_);
    RunTrials(writer);
    throughput_.trials = writer.done();
    RunFalsifications(writer);
    const int left = static_cast<int>(to_do_.size() + falsifications_.size()) - writer.done();
    return {.done = writer.done(),
            .before = before_,
            .left = left,
            .stopped = scheduler_.stopped(),
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
    scheduler_.AsDone(
        groups.size(), [&](std::size_t i) { return PlanOf(groups[i]); },
        [&](std::size_t i, const TimedPlan& planned) { KeepPlan(groups[i], planned); });
  }

  struct TimedPlan {
    PlannedCell planned;
    double seconds = 0;
  };

  // Makes one plan for all cells of the group. If the plan of one of them is stored, that plan is
  // restored.
  TimedPlan PlanOf(const std::vector<std::size_t>& group) const {
    const Clock::time_point start = Clock::now();
    const auto stored = std::ranges::find_if(
        group, [&](std::size_t i) { return stored_.contains(cells_[i].number); });
    PlannedCell planned = stored == group.end()
                              ? work_.plan(cells_[group.front()])
                              : work_.restore(cells_[*stored], stored_.at(cells_[*stored].number));
    return {std::move(planned), SecondsSince(start)};
  }

  void KeepPlan(const std::vector<std::size_t>& group, const TimedPlan& plan) {
    std::vector<CellRecord> added;
    for (const std::size_t i : group) {
      planned_[i] = ForCell(plan.planned, cells_[i]);
      if (!stored_.contains(cells_[i].number)) added.push_back(planned_[i].record);
      ++advance_.cells_planned;
    }
    store_.Add(added, plan.seconds);
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
    const auto keep = [&](std::size_t, TimedTrial timed) {
      throughput_.steps += timed.record.steps;
      writer.Add(std::move(timed));
      ++advance_.trials_done;
      advance_.seconds = SecondsSince(start);
      Tell();
    };
    try {
      scheduler_.InOrder(
          to_do_.size(), [&](std::size_t i) { return RunTrial(to_do_[i]); }, keep);
    } catch (...) {
      writer.Write();
      throw;
    }
    writer.Write();
    throughput_.seconds = SecondsSince(start);
  }

  // ---- falsifications

  // The falsifications share the threads. A thread without a falsification of its own helps with
  // one that is running.
  void RunFalsifications(BatchWriter& writer) {
    falsifications_started_ = Clock::now();
    scheduler_.AsDone(
        falsifications_.size(), [&](std::size_t i) { return RunFalsification(falsifications_[i]); },
        [&](std::size_t, TimedTrial timed) {
          writer.Add(std::move(timed));
          writer.Write();
        });
  }

  // The exception by which the progress callback ends a falsification.
  struct BreakOff {};

  TimedTrial RunFalsification(int trial) {
    std::int64_t made = 0;
    const auto progress = [&](std::int64_t attempts) {
      {
        const std::lock_guard lock(mutex_);
        advance_.attempts_made += std::max(attempts, made) - made;
        made = std::max(attempts, made);
        advance_.falsification_seconds = SecondsSince(falsifications_started_);
        Tell();
      }
      if (scheduler_.Ends()) throw BreakOff();
    };
    const PlannedCell& planned = planned_[PlaceOf(cells_, trial).cell];
    TimedTrial timed = work_.falsification(planned, {.jobs = options_.jobs, .progress = progress});
    SetNumbers(trial, timed.record);
    return timed;
  }

  const Work& work_;
  Store& store_;
  const RunOptions& options_;
  const std::vector<Cell> cells_;
  const std::int64_t attempts_;      // attempts of each falsification
  std::vector<int> to_do_;           // trials; without falsifications once all plans are made
  std::vector<int> falsifications_;  // trials that are falsifications
  int before_ = 0;
  std::map<int, CellRecord> stored_;  // by number of the cell
  std::vector<PlannedCell> planned_;  // by index of the cell
  execution::Scheduler scheduler_;
  std::mutex mutex_;  // guards the advance while falsifications are made
  Advance advance_;
  Throughput throughput_;
  Clock::time_point falsifications_started_;
};

}  // namespace

RunEnd RunSweep(const Sweep& sweep, const Work& work, Store& store, const RunOptions& options) {
  return Running(sweep, work, store, options).Execute();
}

}  // namespace assay::sweep
