#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace assay::cli {

// Tells people on a terminal what is being done and for how long, on one line of standard error,
// once it has taken a second. Elsewhere, nothing. The line is wiped at the end.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void Tell(std::string what);  // from any thread

 private:
  void Show(std::stop_token stop);

  std::mutex mutex_;
  std::condition_variable_any ended_;
  std::string what_;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace assay::cli
