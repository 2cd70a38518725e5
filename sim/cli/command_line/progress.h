#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>

#include "sim/cli/command_line/stopwatch.h"

namespace assay::cli {

// How much of the work is done: 3 of 20 trials.
struct Count {
  std::int64_t done = 0;
  std::int64_t of = 0;
  std::string what;  // plural: "trials"
};

// Tells people on standard error what is being done and for how long, and if the work is counted,
// how much is done, at what rate, and how long the rest will take. On a terminal this is one line,
// which appears after a second and is wiped at the end. Elsewhere it is a line after ten seconds,
// and further lines at intervals that double up to ten minutes.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // May be called from any thread. The rate is that since the first count of the same work.
  void Tell(std::string what);
  void Tell(const Count& count);

 private:
  void Show(std::stop_token stop);
  std::string Line() const;

  std::mutex mutex_;
  std::condition_variable_any ended_;
  const Stopwatch stopwatch_;
  std::string what_;
  Count first_;  // of 0: the work is not counted
  Count last_;
  double counted_since_ = 0;  // seconds
  std::jthread thread_;       // last, since it uses the members above
};

// Returns a duration for lines of progress: "17 s", "4 min", "2 h 5 min".
std::string DurationText(double seconds);

}  // namespace assay::cli
