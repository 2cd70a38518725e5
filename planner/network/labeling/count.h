#pragma once

#include <cstdint>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/constraint_network/counters.h"
#include "planner/network/constraint_network/network.h"

namespace assay::network {

struct LabelingCount {
  Outcome outcome = Outcome::kNone;  // for kBudget the count is 0 and has no meaning
  std::uint64_t count = 0;           // kManyLabelings stands for that many or more
  Counters counters;
};
inline constexpr std::uint64_t kManyLabelings = ~std::uint64_t{0};

// Counts the labelings of the network without listing them. It first decides whether there is one.
// It then branches on nodes until the remaining components are trees. Trees are counted from the
// leaves, and the counts of independent components are multiplied (cycle cutsets: Dechter and Pearl
// 1987).
LabelingCount Count(const Network& network, Budget& budget);

}  // namespace assay::network
