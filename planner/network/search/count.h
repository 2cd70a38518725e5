#pragma once

#include <cstdint>

#include "planner/base/budget.h"
#include "planner/base/outcome.h"
#include "planner/network/network/counters.h"
#include "planner/network/network/network.h"

namespace assay::network {

struct LabelingCount {
  Outcome outcome = Outcome::kNone;  // kBudget: the count is 0 and says nothing
  std::uint64_t count = 0;           // kManyLabelings: as many or more
  Counters counters;
};
inline constexpr std::uint64_t kManyLabelings = ~std::uint64_t{0};

// How many labelings the network has, without listing them: once it is known to have one, nodes are
// branched on until what is left falls into trees, which are counted from the leaves, and the
// counts of parts that do not depend on each other are multiplied (cycle cutsets: Dechter and Pearl
// 1987).
LabelingCount Count(const Network& network, Budget& budget);

}  // namespace assay::network
