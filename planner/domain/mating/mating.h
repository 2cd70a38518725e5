#pragma once

#include <utility>
#include <vector>

#include "planner/base/id.h"
#include "planner/domain/part/stable_pose.h"
#include "planner/geometry/pose.h"

namespace assay::domain {

using PartId = Id<struct PartTag>;      // a part of the problem
using MatingId = Id<struct MatingTag>;  // a mating that the problem speaks of

// assembled(Obj1, Obj2, Features, Ta, Vec) of Spar: which features meet, where the held part ends
// in the frame of the fixed part, and along which vector the last motion goes there.
struct Mating {
  PartId held;
  PartId fixed;
  std::vector<std::pair<FeatureNumber, FeatureNumber>> features;  // of held, of fixed
  geometry::Pose X_FixedHeld;                                     // Ta
  geometry::Vector3 mating_vector;  // metres, frame of the fixed part; the motion starts at
                                    // X_FixedHeld displaced by minus this vector
};

}  // namespace assay::domain
