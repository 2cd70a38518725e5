#include "sim/cli/command_line/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "planner/base/input_files/quotation.h"
#include "sim/cli/command_line/console.h"

namespace assay::cli {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr Seconds kSilenceOnTerminal(1);
constexpr Seconds kIntervalOnTerminal(0.25);
constexpr Seconds kSilence(10);
constexpr Seconds kLongestInterval(600);

std::string RateText(double per_second) {
  return per_second >= 1 ? fmt::format("{:.1f}/s", per_second)
                         : fmt::format("{:.1f} s each", 1 / per_second);
}

}  // namespace

Progress::Progress(std::string what) : what_(std::move(what)) {
  thread_ = std::jthread([this](std::stop_token stop) { Show(std::move(stop)); });
}

Progress::~Progress() = default;

void Progress::Tell(std::string what) {
  const std::lock_guard lock(mutex_);
  what_ = std::move(what);
  first_ = last_ = {};
}

void Progress::Tell(const Count& count) {
  const std::lock_guard lock(mutex_);
  if (first_.of != count.of || first_.what != count.what) {
    first_ = count;
    counted_since_ = stopwatch_.Seconds();
  }
  last_ = count;
}

std::string Progress::Line() const {
  const double seconds = stopwatch_.Seconds();
  if (last_.of == 0) return fmt::format("{} ({})", assay::Show(what_), DurationText(seconds));
  std::string line = fmt::format("{}, {} of {} {} ({}", assay::Show(what_), last_.done, last_.of,
                                 last_.what, DurationText(seconds));
  const double made = static_cast<double>(last_.done - first_.done);
  const double taken = seconds - counted_since_;
  if (made > 0 && taken > 0) {
    const double left = static_cast<double>(last_.of - last_.done) * taken / made;
    line += fmt::format(", {}, {} left", RateText(made / taken), DurationText(left));
  }
  return line + ")";
}

void Progress::Show(std::stop_token stop) {
  const bool is_terminal = RemarksAreSeen();
  Seconds interval = is_terminal ? kSilenceOnTerminal : kSilence;
  std::unique_lock lock(mutex_);
  const auto stopped = [&stop] { return stop.stop_requested(); };
  bool shown = false;
  while (!ended_.wait_for(lock, stop, interval, stopped)) {
    Remark(is_terminal ? "\r" + Line() + "\033[K" : Line() + "\n");
    shown = true;
    interval = is_terminal ? kIntervalOnTerminal : std::min(kLongestInterval, 2 * interval);
  }
  if (shown && is_terminal) Remark("\r\033[K");
}

std::string DurationText(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 120) return fmt::format("{} s", whole);
  const long minutes = std::lround(seconds / 60);
  if (minutes < 120) return fmt::format("{} min", minutes);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

}  // namespace assay::cli
