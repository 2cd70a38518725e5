#pragma once

#include <cstdint>

#include "planner/base/outcome.h"
#include "planner/network/constraint_network/labeling.h"

namespace assay::peers {

// A contestant's answer about a network. kBudget means that its time was up.
struct LabelingAnswer {
  Outcome outcome = Outcome::kNone;
  network::Labeling labeling;  // set with kFound
  std::int64_t visited = 0;    // nodes of the search tree, or decisions
};

struct CountAnswer {
  Outcome outcome = Outcome::kNone;
  std::uint64_t count = 0;
  std::int64_t visited = 0;
};

}  // namespace assay::peers
