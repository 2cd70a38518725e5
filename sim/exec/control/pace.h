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
// Where a part may meet what it is put on or into. The arm weighs as much as many parts: what it
// runs into at 20 mm/s slides on by 0.1 mm, with the square of speed; here, by a micrometre.
inline constexpr double kContactSpeed = 0.002;
// A part that comes down on the table, which it may meet in the last `length` of its way.
inline constexpr Pace LandingPace(double length) {
  return {.speed = 0.5, .final_speed = kContactSpeed, .final_length = length};
}
// A part on its way into another, which it may meet in the last `length`. It is slow before, too:
// the rim of a hole catches what overlaps it by more than speed times step, 10 micrometres here,
// well below the clearance.
inline constexpr Pace MatingPace(double length) {
  return {.speed = 0.02, .final_speed = kContactSpeed, .final_length = length};
}
// A part that is to feel whether there is a rim below it.
inline constexpr Pace kProbingPace = {.speed = 0.005, .final_speed = 0.005, .final_length = 10};
// A part that is moved over the rim of a hole.
inline constexpr Pace kGropingPace = {.speed = 0.02, .final_speed = 0.02, .final_length = 10};

}  // namespace assay::exec
