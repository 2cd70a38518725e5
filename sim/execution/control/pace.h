#pragma once

namespace assay::execution {

// The pace of the tool along a straight line: `speed` (m/s), and `final_speed` over the last
// `final_length` metres, where something may be touched. The limits of the joints may make the tool
// slower.
struct Pace {
  double speed = 0;
  double final_speed = 0;
  double final_length = 0;
};

// The pace in free space.
inline constexpr Pace kFreePace = {.speed = 0.5, .final_speed = 0.5, .final_length = 0};
// The pace of open fingers beside a part, toward it or away from it.
inline constexpr Pace kFingersPace = {.speed = 0.2, .final_speed = 0.02, .final_length = 0.005};
// The speed, in m/s, at which a part may meet the part or table that it is put on or into. The arm
// is much heavier than a part. A part that the arm hits at 20 mm/s slides on by 0.1 mm. The
// distance grows with the square of the speed; at this speed it is a micrometre.
inline constexpr double kContactSpeed = 0.002;
// Returns the pace with which the arm lowers a part, which may meet the table in the last `length`
// metres.
inline constexpr Pace LandingPace(double length) {
  return {.speed = 0.5, .final_speed = kContactSpeed, .final_length = length};
}
// Returns the pace of a part on its way into another part, which it may meet in the last `length`
// metres. The way before these metres is slow as well. At the rim of a hole, the engine stops a
// part only if the part overlaps the rim by more than the part moves in one timestep. At this pace,
// the part moves by 10 micrometres in a timestep, which is well below the clearance.
inline constexpr Pace MatingPace(double length) {
  return {.speed = 0.02, .final_speed = kContactSpeed, .final_length = length};
}
// The pace of a part that probes for a rim below it.
inline constexpr Pace kProbingPace = {.speed = 0.005, .final_speed = 0.005, .final_length = 10};
// The pace of a part that moves over the rim of a hole.
inline constexpr Pace kGropingPace = {.speed = 0.02, .final_speed = 0.02, .final_length = 10};

}  // namespace assay::execution
