#pragma once

#include <numbers>

namespace assay::domain {

// Half widths of how far the held part of a mating may be from where the hand believes it: those
// that the mating alone is to be planned for. Whole plans compute theirs from what they do before,
// but for the velocity's, which is the arm's.
struct MatingErrors {
  double displacement = 0.002;                   // metres, in each of x, y and z
  double rotation = 1 * std::numbers::pi / 180;  // radians, about each of them
  // Of a motion in fine motion, in each direction: a share of its length (Dakin and Popplestone,
  // section 2: control velocity error).
  double velocity = 0.002;

  bool operator==(const MatingErrors&) const = default;
};

}  // namespace assay::domain
