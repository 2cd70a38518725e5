#pragma once

#include <string>
#include <vector>

#include "planner/base/id.h"
#include "planner/geometry/polygon.h"
#include "planner/geometry/pose.h"

namespace assay::domain {

class PartModel;
using FeatureNumber = Id<struct FeatureTag>;  // number in the part file
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

// Returns the stable poses: the hull facets over which the centre of mass lies, at least
// `least_tilt` radians from tipping, in the order of the hull's facets. Yaw 0 is defined by the
// first of the part's x, y, z axes that leans more than 45 degrees away from the vertical.
// Projected onto the table, this axis points along the table's x.
std::vector<StablePose> ComputeStablePoses(const PartModel& part, double least_tilt);

}  // namespace assay::domain
