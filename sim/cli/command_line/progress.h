#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace assay::cli {

// Shows on a terminal what is being done and for how long, on one line of standard error, once it
// has taken a second. The line is wiped at the end. Nothing is shown if standard error is no
// terminal.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Tell(std::string what);  // may be called from any thread

 private:
  void Show(std::stop_token stop);

  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::string what_;
  std::jthread thread_;  // last, since it uses the members above
};

}  // namespace assay::cli
