#include "sim/cli/command_line/progress.h"

#include <fmt/format.h>

#include <chrono>

#include "planner/base/input_files/quotation.h"
#include "sim/cli/command_line/console.h"

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
  if (!RemarksAreSeen()) return;
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
    Remark(fmt::format("\r{} ({:.0f} s)\033[K", assay::Show(what_), SecondsSince(start)));
  } while (!ended_.wait_for(lock, stop, kInterval, stopped));
  Remark("\r\033[K");
}

}  // namespace assay::cli
