#pragma once

#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/domain/parts/feature.h"
#include "planner/geometry/coordinates.h"

namespace assay::domain {

using StablePoseId = Id<struct StablePoseTag>;

// One way in which a part rests on the table: everything about its pose except x, y and yaw (Spar,
// "Stable Poses and Position Classes").
struct StablePose {
  std::string label;                  // in the paper's form xPy: "BP5"
  std::string name;                   // name in the part file: "on-back"; may be empty
  geometry::Pose X_TablePart;         // at yaw 0, with the part's origin above the table's origin
  std::vector<FeatureNumber> hidden;  // features that the table touches or covers, increasing
  geometry::Polygon support;          // table coordinates, at yaw 0
  double tilt_margin = 0;  // radians the part may be tilted over its nearest support edge
                           // before it falls
};

}  // namespace assay::domain
