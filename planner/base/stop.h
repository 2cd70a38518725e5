#pragma once

#include <atomic>

namespace assay {

// Thrown by work that ends because a stop was requested.
struct Stopped {};

// True while all long work of this process is to end. A signal's handler may set it.
inline std::atomic<bool> stop_requested = false;
static_assert(std::atomic<bool>::is_always_lock_free);

// Loops that may run for long call this in each round.
inline void StopIfRequested() {
  if (stop_requested.load(std::memory_order_relaxed)) throw Stopped();
}

}  // namespace assay
