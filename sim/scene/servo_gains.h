#pragma once

#include <array>

namespace assay::scene {

// The servo of one arm joint. The armature is the motor's inertia as seen through the gear. The
// armature values are those of the Puma 560 (Corke and Armstrong-Helouvry), scaled to the size of
// the Puma 762 by the fifth power of length.
struct ServoGains {
  double armature = 0;   // kg m^2
  double stiffness = 0;  // N m / rad
  double damping = 0;    // N m s / rad, nearly critical for the inertia of armature and links
};

inline constexpr std::array<ServoGains, 6> kServoGains = {{
    {.armature = 6.1, .stiffness = 8e5, .damping = 8000},
    {.armature = 18.0, .stiffness = 8e5, .damping = 10000},
    {.armature = 4.5, .stiffness = 6e5, .damping = 5000},
    {.armature = 1.5, .stiffness = 8e4, .damping = 700},
    {.armature = 1.3, .stiffness = 8e4, .damping = 700},
    {.armature = 1.5, .stiffness = 8e4, .damping = 700},
}};

}  // namespace assay::scene
