#pragma once

#include <cstdint>

#include "planner/motion/collision/motion_check.h"
#include "planner/motion/paths/joint_path.h"

namespace assay::motion {

struct ShorteningEffort {
  int shortcuts = 60;
  std::int64_t postures = 20'000;  // greatest number tested; the last motion may take some more
  std::uint64_t seed = 1;
};

// Returns a free path that is no slower, from rest to rest in each corner. Corners that a free
// motion can pass by are left out first. Then a motion between two random points of the path
// replaces the path between them, if it is free and quicker (Geraerts and Overmars, "Creating
// High-quality Paths for Motion Planning", 2007).
JointPath Shortened(JointPath path, MotionCheck& check, const ShorteningEffort& effort);

}  // namespace assay::motion
