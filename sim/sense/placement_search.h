#pragma once

#include <span>

#include "sim/sense/displacement.h"
#include "sim/sense/edge_search.h"

namespace assay::sense {

// How far from the believed place a part is looked for.
struct SearchWindow {
  double distance = 0.016;  // metres to each side in x and in y
  double yaw = 0.21;        // radians to each side
  double height = 0.006;    // metres, up and down
};

// The displacement in x, y and yaw, on a coarse grid of the window, for which the silhouette of the
// boxes (world frame, where believed) covers most of what has the part's colour and least of the
// table in all pictures together; of equal ones the nearest to the believed place. Height is not
// looked for: it moves the pictures by less than the grid's step.
Displacement CoarsePlacement(std::span<const Picture> pictures, const domain::PartModel& model,
                             const Pose& believed, const SearchWindow& window);

}  // namespace assay::sense
