#include "sim/cli/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace assay::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kSilence(1000);
constexpr std::chrono::milliseconds kInterval(250);

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

Progress::Progress(std::string what) : what_(std::move(what)) {
  if (isatty(STDERR_FILENO) == 0) return;
  thread_ = std::jthread([this](std::stop_token stop) { Show(std::move(stop)); });
}

Progress::~Progress() = default;

void Progress::Tell(std::string what) {
  const std::lock_guard lock(mutex_);
  what_ = std::move(what);
}

void Progress::Show(std::stop_token stop) {
  const Clock::time_point start = Clock::now();
  std::unique_lock lock(mutex_);
  const auto stopped = [&stop] { return stop.stop_requested(); };
  if (ended_.wait_for(lock, stop, kSilence, stopped)) return;
  do {
    fmt::print(stderr, "\r{} ({:.0f} s)\033[K", what_, SecondsSince(start));
    std::fflush(stderr);
  } while (!ended_.wait_for(lock, stop, kInterval, stopped));
  fmt::print(stderr, "\r\033[K");
}

}  // namespace assay::cli
