#pragma once

#include <utility>
#include <vector>

#include "planner/base/id.h"
#include "planner/domain/resting/stable_pose.h"
#include "planner/geometry/coordinates.h"

namespace assay::domain {

using PartId = Id<struct PartTag>;      // a part of the problem
using MatingId = Id<struct MatingTag>;  // a mating of the problem

// assembled(Obj1, Obj2, Features, Ta, Vec) of Spar: the features that meet, the end pose of the
// held part in the frame of the fixed part, and the vector along which the last motion goes there.
struct Mating {
  PartId held;
  PartId fixed;
  // Feature of the held part, feature of the fixed part.
  std::vector<std::pair<FeatureNumber, FeatureNumber>> features;
  geometry::Pose X_FixedHeld;       // Ta
  geometry::Vector3 mating_vector;  // metres, frame of the fixed part; the motion starts at
                                    // X_FixedHeld displaced by minus this vector
  // True if nothing of the fixed part stops the motion at its end. The table on which the fixed
  // part lies stops it, as for a shaft that goes through its hole. It then carries the held part.
  bool ends_on_table = false;
};

}  // namespace assay::domain
