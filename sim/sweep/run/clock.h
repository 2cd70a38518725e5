#pragma once

#include <chrono>

namespace assay::sweep {

// Wall time: no result depends on it.
using Clock = std::chrono::steady_clock;

inline double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace assay::sweep
