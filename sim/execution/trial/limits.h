#pragma once

#include <numbers>

namespace assay::execution {

// The limits of success besides those of a mating, in metres, radians and seconds. How far a mated
// part may be off its place is in planner/domain/matings/mating_success.h.
struct Limits {
  // The gripper counts as open if its pads are this much farther apart than they were on the part.
  double released = 0.001;
  // Parts at rest move more slowly than this for half a second. Parts in the engine reach 1e-6.
  double speed = 0.001;         // m/s
  double angular_speed = 0.02;  // rad/s
  // The limits within which domain::StablePoseAt takes a part to rest in a stable pose.
  double tilt = std::numbers::pi / 180;
  double height = 0.001;
};

}  // namespace assay::execution
