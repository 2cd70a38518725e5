#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/contingent/plan_tree/plan_tree.h"

namespace assay::contingent {

struct TreeCheck {
  bool holds = false;
  // If the tree does not hold: the condition that fails, its place in the tree, and the world.
  std::string failure;
  std::int64_t worlds = 0;
  bool were_drawn = false;  // true if the worlds were a random sample of too many
  bool are_numbers_sampled = false;
  std::vector<NodeId> unreached;  // nodes that no world reached

  bool AreAllWorlds() const { return !were_drawn && !are_numbers_sampled; }
};

}  // namespace assay::contingent
