#pragma once

#include <ctime>

namespace assay::peers {

// Returns the processor time of this thread in seconds. Contestants' limits are in processor time,
// so that a loaded machine gives no contestant less.
inline double ProcessorSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace assay::peers
