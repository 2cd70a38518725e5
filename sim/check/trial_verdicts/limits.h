#pragma once

#include <numbers>

namespace assay::check {

// The limits that define success, in metres, radians and seconds.
struct Limits {
  // The greatest distance that may remain along the mating vector. A millimetre is more than a
  // feeler gauge shows and less than the eye sees. A part that has caught on a rim is centimetres
  // off.
  double seated = 0.001;
  // A shaft in its hole is off by no more than the clearance, along each side of the hole. This is
  // the allowance beyond that, for penetration and for the tilt of the fixed part.
  double lateral_slack = 0.0002;
  // A shaft of 70 mm with a clearance of 0.5 mm cannot tilt by more than 0.8 degrees.
  double axis_angle = 1.5 * std::numbers::pi / 180;
  // The greatest alignment error, as a multiple of the clearance. The clearance lets the shaft move
  // by up to 1.4 times its value, into a corner of the hole. The clearance lets the shaft turn,
  // too. A hole of the part may be 1.5 times as far from the axis as the shaft's side, and the turn
  // then moves this hole by 1.5 times the clearance.
  double alignment_clearances = 3;
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
