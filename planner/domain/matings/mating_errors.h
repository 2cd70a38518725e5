#pragma once

#include <numbers>

namespace assay::domain {

// The greatest errors, as half widths, of the held part of a mating against its believed pose, for
// a mating that is planned by itself. Whole plans compute these errors from the actions before the
// mating. The velocity error is used in both cases, because it is an error of the arm.
struct MatingErrors {
  double displacement = 0.002;                   // metres, in each of x, y and z
  double rotation = 1 * std::numbers::pi / 180;  // radians, about each of them
  // Error of a motion in fine motion, in each direction, as a share of its length (Dakin and
  // Popplestone, section 2: control velocity error).
  double velocity = 0.002;

  bool operator==(const MatingErrors&) const = default;
};

}  // namespace assay::domain
