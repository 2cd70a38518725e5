#pragma once

#include <ctime>

namespace assay::peers {

// Processor time of this thread in seconds: what a contestant's limit is of, so that a loaded
// machine gives nobody less.
inline double ProcessorSeconds() {
  timespec now = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace assay::peers
