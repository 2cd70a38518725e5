#pragma once

#include <functional>
#include <vector>

#include "sim/sweep/run/grid.h"
#include "sim/sweep/run/work.h"
#include "sim/sweep/store/store.h"

namespace assay::sweep {

// How far a run is.
struct Advance {
  int cells_planned = 0;
  int cells = 0;
  // Of trials that are no attacks.
  int trials_done = 0;  // by this run
  int trials = 0;       // of this run; 0 until all plans are made
  double seconds = 0;   // since the first trial of this run began
  // Of attacks, which follow.
  std::int64_t attempts_made = 0;  // by this run
  std::int64_t attempts = 0;       // of this run, at most; 0 until all plans are made
  double attack_seconds = 0;       // since the first attack of this run began
};

struct RunOptions {
  int jobs = 1;  // threads
  Shard shard = {};
  int batch = 32;                   // trials that are written at once, at most,
  double batch_seconds = 1;         // or as many as were done in this time
  std::function<bool()> stop = {};  // asked before each trial and attempt; empty: never
  // After each plan, trial and attempt, from any thread, one at a time.
  std::function<void(const Advance&)> tell = {};
};

// What a run came to.
struct RunEnd {
  int done = 0;    // trials, by this run
  int before = 0;  // trials of its shard that were there already
  int left = 0;    // trials of its shard that are still to be done
  bool stopped = false;
  Throughput throughput = {};  // of this run
};

// Does the trials of the shard that are not in the store yet: makes the plans of their cells, one
// for all cells that differ in noise alone, then runs the trials, both in parallel, and writes the
// results in batches in the order of the trials. Attacks come last, several side by side, each of
// which may use all threads that the others leave; each is written when it is done. A cell without
// a plan has no trials. Throws what the work or the store threw; what had been done until then is
// written.
RunEnd RunSweep(const Sweep& sweep, const Work& work, Store& store, const RunOptions& options);

}  // namespace assay::sweep
