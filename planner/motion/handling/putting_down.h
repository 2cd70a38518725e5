#pragma once

#include <optional>
#include <vector>

#include "planner/motion/collision/surroundings.h"

namespace assay::motion {

// Returns the pose of a part that the hand has moved straight down, or up, from X_WorldPart until
// its lowest point is on the tables.
Pose StraightBelow(const domain::Part& part, Pose X_WorldPart);

// The functions below look for poses where the held part may be put down (world frame). They turn
// X_WorldBelow, a pose of the part with its lowest point on the tables, about the vertical by
// eighths of a turn, and move it sideways. `surroundings` must have a held part, and the parts that
// stand on the tables at their believed poses.

// Returns the poses over the table, for putting down the held part, with room for the part and for
// fingers that open, the nearest to the table's middle first. Whether the arm reaches them is not
// asked.
std::vector<Pose> FreePosesOn(const domain::Table& table, const domain::Problem& problem,
                              const Surroundings& surroundings, const Pose& X_WorldBelow);

// Returns the first pose in the place where the arm can put down the held part, with room for the
// part and for the open fingers. All turns are tried at one spot before the next spot. Returns none
// if there is no such pose.
std::optional<Pose> FreePoseIn(const domain::Place& place, const domain::Problem& problem,
                               const Surroundings& surroundings, const Pose& X_WorldBelow);

}  // namespace assay::motion
