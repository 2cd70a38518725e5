#pragma once

#include <numbers>

namespace assay::check {

// What success means, in numbers. Metres, radians, seconds.
struct Limits {
  // A millimetre: what is left of the way along the mating vector, between feeler gauge and eye. A
  // part that has caught on a rim is centimetres off.
  double seated = 0.001;
  // A shaft in its hole is off by the clearance at most, along each side of the hole; this much
  // more is forgiven for penetration and for the tilt of the fixed part.
  double lateral_slack = 0.0002;
  // A shaft of 70 mm with a clearance of 0.5 mm cannot tilt by more than 0.8 degrees.
  double axis_angle = 1.5 * std::numbers::pi / 180;
  // The clearance moves the shaft (by up to 1.4 times, into a corner of the hole) and turns it: at
  // a hole one and a half times as far from the axis as the shaft's side, by 1.5 times more.
  double alignment_clearances = 3;
  // The gripper is open if its pads are this much farther apart than they were on the part.
  double released = 0.001;
  // Parts at rest move slower than this for half a second. The engine's parts come to 1e-6.
  double speed = 0.001;         // m/s
  double angular_speed = 0.02;  // rad/s
  // What domain::StablePoseAt calls resting in a stable pose.
  double tilt = std::numbers::pi / 180;
  double height = 0.001;
};

}  // namespace assay::check
