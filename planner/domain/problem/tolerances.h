#pragma once

namespace assay::domain {

// How far what is the same for the whole problem may truly be from what the problem says: half
// widths of intervals about it.
struct Tolerances {
  double clearance = 0;     // metres on each side of a mated shaft; less than the clearance
  double friction = 0;      // of mating surfaces, and so of parts; less than theirs
  double pad_friction = 0;  // of the gripper's pads; less than theirs

  bool operator==(const Tolerances&) const = default;
};

}  // namespace assay::domain
