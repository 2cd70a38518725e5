#pragma once

#include <span>

#include "sim/sense/displacement.h"
#include "sim/sense/fitting/edge_search.h"

namespace assay::sense {

// The greatest distances from the believed pose at which a part is searched.
struct SearchWindow {
  double distance = 0.016;  // metres to each side in x and in y
  double yaw = 0.21;        // radians to each side
  double height = 0.006;    // metres, up and down
};

// Returns the displacement from the believed pose in x, y and yaw, on a coarse grid of the window,
// whose silhouette fits all pictures together best. The best silhouette covers most of what has the
// part's colour and least of the table. Among equal ones the nearest to the believed pose is taken.
// Height is not searched, because it moves the pictures by less than the grid's step.
Displacement CoarsePlacement(std::span<const Picture> pictures, const domain::PartModel& model,
                             const Pose& believed, const SearchWindow& window);

}  // namespace assay::sense
