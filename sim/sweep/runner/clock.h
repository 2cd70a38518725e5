#pragma once

#include <chrono>

namespace assay::sweep {

// Returns the seconds of wall time since `start`. No result depends on wall time.
using Clock = std::chrono::steady_clock;

inline double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace assay::sweep
