#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/contingent/tree/plan_tree.h"

namespace assay::contingent {

struct TreeCheck {
  bool holds = false;
  // If not: what fails, where in the tree, and in which world.
  std::string failure;
  std::int64_t worlds = 0;           // that were run to a leaf; as sets: initial ones
  bool were_drawn = false;           // the worlds, of too many
  bool are_numbers_sampled = false;  // what lies between them may be otherwise
  std::vector<NodeId> unreached;     // nodes that no world came to

  bool AreAllWorlds() const { return !were_drawn && !are_numbers_sampled; }
};

}  // namespace assay::contingent
