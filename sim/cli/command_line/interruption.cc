#include "sim/cli/command_line/interruption.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <csignal>

#include "planner/base/stop.h"

namespace assay::cli {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

std::atomic<int> taken_down = 0;  // the recorded signal, or 0
static_assert(std::atomic<int>::is_always_lock_free, "it is set by a signal's handler");

extern "C" void TakeDown(int signal) {
  taken_down = signal;
  stop_requested = true;
  std::signal(signal, SIG_DFL);
}

void Handle(void (*handler)(int)) {
  for (const int signal : kSignals) {
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

}  // namespace

Interruption::Interruption() {
  taken_down = 0;
  stop_requested = false;
  Handle(TakeDown);
}

Interruption::~Interruption() {
  Handle(SIG_DFL);
  stop_requested = false;
}

bool Interruption::Requested() { return taken_down != 0; }

ExitCode Interruption::CodeOr(ExitCode code) {
  if (!Requested()) return code;
  return taken_down == SIGINT ? ExitCode::kInterrupted : ExitCode::kTerminated;
}

std::string Interruption::Text(long long made, long long wanted, const char* done) {
  if (!Requested()) return "";
  return fmt::format("interrupted: {} of {} {}\n", made, wanted, done);
}

}  // namespace assay::cli
