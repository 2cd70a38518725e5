#include "sim/cli/interruption.h"

#include <atomic>
#include <csignal>

namespace assay::cli {
namespace {

std::atomic<bool> requested = false;
static_assert(std::atomic<bool>::is_always_lock_free, "it is set by a signal's handler");

extern "C" void TakeDown(int signal) {
  requested = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interruption::Interruption() {
  requested = false;
  std::signal(SIGINT, TakeDown);
  std::signal(SIGTERM, TakeDown);
}

Interruption::~Interruption() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

bool Interruption::Requested() { return requested; }

}  // namespace assay::cli
