#pragma once

#include <span>

struct mjModel_;

namespace assay::mujoco {

// The engine's own test of the bits of two geoms, which a filter replaces: returns whether they may
// touch.
bool BitsMatch(const mjModel_& m, int geom1, int geom2);

// While an object of this class lives, the engine looks on this thread only for contacts between
// bodies of different groups. `groups` has the group of each body, in the order of the model.
class GroupFilter {
 public:
  explicit GroupFilter(std::span<const int> groups);
  ~GroupFilter();
  GroupFilter(const GroupFilter&) = delete;
  GroupFilter& operator=(const GroupFilter&) = delete;
};

}  // namespace assay::mujoco
