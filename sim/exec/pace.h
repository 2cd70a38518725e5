#pragma once

namespace assay::exec {

// How fast the tool goes along a straight line: `speed` (m/s), and `final_speed` over the last
// `final_length` metres, where something may be touched. What the joints allow may be less.
struct Pace {
  double speed = 0;
  double final_speed = 0;
  double final_length = 0;
};

// In free space.
inline constexpr Pace kFreePace = {.speed = 0.5, .final_speed = 0.5, .final_length = 0};
// Open fingers beside a part, going to it or leaving it.
inline constexpr Pace kFingersPace = {.speed = 0.2, .final_speed = 0.02, .final_length = 0.005};
// A part that comes down on the table, whose height is known to within `travel`. At 10 mm/s and
// steps of half a millisecond it meets the table with 5 micrometres of penetration at most.
inline constexpr Pace LandingPace(double travel) {
  return {.speed = 0.5, .final_speed = 0.01, .final_length = 2 * travel + 0.002};
}
// A part on its way into another, slow over any length. The rim of a hole catches what overlaps it
// by more than speed times step, 10 micrometres here: well below the clearance.
inline constexpr Pace kMatingPace = {.speed = 0.02, .final_speed = 0.02, .final_length = 10};

}  // namespace assay::exec
