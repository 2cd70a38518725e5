#pragma once

#include <cstdint>

namespace assay::network {

// Counts of the work done on a network. They do not depend on the machine.
struct Counters {
  std::int64_t visited = 0;    // nodes of search trees: the number of labels tried
  std::int64_t wipe_outs = 0;  // label sets that became empty
  std::int64_t revisions = 0;  // arcs made consistent in one direction

  bool operator==(const Counters&) const = default;
};

inline Counters operator+(const Counters& a, const Counters& b) {
  return {a.visited + b.visited, a.wipe_outs + b.wipe_outs, a.revisions + b.revisions};
}

inline Counters operator-(const Counters& a, const Counters& b) {
  return {a.visited - b.visited, a.wipe_outs - b.wipe_outs, a.revisions - b.revisions};
}

}  // namespace assay::network
