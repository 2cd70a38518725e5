#pragma once

#include <numbers>

namespace assay::check {

// The limits that define success, in metres, radians and seconds. How far a mated part may be off
// its place is in planner/domain/matings/mating_success.h, since plans must prove it.
struct Limits {
  // The greatest distance that may remain along the mating vector. A millimetre is more than a
  // feeler gauge shows and less than the eye sees. A part that has caught on a rim is centimetres
  // off.
  double seated = 0.001;
  // A shaft of 70 mm with a clearance of 0.5 mm cannot tilt by more than 0.8 degrees.
  double axis_angle = 1.5 * std::numbers::pi / 180;
  // The gripper counts as open if its pads are this much farther apart than they were on the part.
  double released = 0.001;
  // Parts at rest move more slowly than this for half a second. Parts in the engine reach 1e-6.
  double speed = 0.001;         // m/s
  double angular_speed = 0.02;  // rad/s
  // The limits within which domain::StablePoseAt takes a part to rest in a stable pose.
  double tilt = std::numbers::pi / 180;
  double height = 0.001;
};

}  // namespace assay::check
