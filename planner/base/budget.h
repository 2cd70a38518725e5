#pragma once

#include <cstdint>

#include "planner/base/stop.h"

namespace assay {

// A limit on work. It is counted in nodes or steps and never in seconds, so that the same input
// gives the same answer on every machine.
class Budget {
 public:
  explicit Budget(std::int64_t limit) : limit_(limit) {}

  // Takes one unit. Returns false from the first call after all units are spent. Throws Stopped if
  // a stop was requested.
  bool Spend() {
    StopIfRequested();
    return ++spent_ <= limit_;
  }
  bool Exhausted() const { return spent_ > limit_; }
  std::int64_t spent() const { return spent_ < limit_ ? spent_ : limit_; }
  std::int64_t limit() const { return limit_; }

 private:
  std::int64_t limit_;
  std::int64_t spent_ = 0;
};

}  // namespace assay
