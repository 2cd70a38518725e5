#pragma once

#include <array>

namespace assay::kinematics {

// The position servo of one arm joint.
struct ServoGains {
  double armature = 0;   // the motor's inertia as seen through the gear, kg m^2
  double stiffness = 0;  // N m / rad
  double damping = 0;    // N m s / rad
};

using ArmServos = std::array<ServoGains, 6>;  // joint 1 first

}  // namespace assay::kinematics
