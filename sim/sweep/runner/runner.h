#pragma once

#include <functional>
#include <vector>

#include "sim/sweep/database/store.h"
#include "sim/sweep/grid/grid.h"
#include "sim/sweep/runner/work.h"

namespace assay::sweep {

// The progress of a run.
struct Advance {
  int cells_planned = 0;
  int cells = 0;
  // Trials that are not falsifications.
  int trials_done = 0;  // trials that this run has done
  int trials = 0;       // all trials of this run; 0 until all plans are made
  double seconds = 0;   // since the first trial of this run began
  // Falsifications, which follow after the other trials.
  std::int64_t attempts_made = 0;    // attempts that this run has made
  std::int64_t attempts = 0;         // the most attempts of this run; 0 until all plans are made
  double falsification_seconds = 0;  // since the first falsification of this run began
};

struct RunOptions {
  int jobs = 1;  // threads
  Shard shard = {};
  int batch = 32;                   // results are written once there are this many trials
  double batch_seconds = 1;         // or once this time has passed since the last writing
  std::function<bool()> stop = {};  // asked before each trial and attempt; empty: never stops
  // Called after each plan, trial and attempt. Any thread may call it, but never two at the same
  // time.
  std::function<void(const Advance&)> tell = {};
};

// The result of a run.
struct RunEnd {
  int done = 0;    // trials that this run has done
  int before = 0;  // trials of its shard that were done before
  int left = 0;    // trials of its shard that are still to be done
  bool stopped = false;
  Throughput throughput = {};
};

// Does the trials of the shard that are not in the store yet. First it makes the plans of their
// cells in parallel, one plan for all cells that differ only in noise, sensing and seed. Then it
// runs the trials in parallel and writes their results in batches in the order of the trials.
// Falsifications come last. Several falsifications run side by side, and each may use all threads
// that the others leave free. The result of each falsification is written as soon as this
// falsification is done. A cell without a plan has no trials. Rethrows what the work or the store
// threw, after it has written what was done until then.
RunEnd RunSweep(const Sweep& sweep, const Work& work, Store& store, const RunOptions& options);

}  // namespace assay::sweep
