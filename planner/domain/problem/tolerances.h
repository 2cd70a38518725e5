#pragma once

namespace assay::domain {

// Tolerances of quantities that hold for the whole problem: the half widths of intervals about the
// values that the problem states.
struct Tolerances {
  double clearance = 0;     // metres, on each side of a mated shaft; less than the clearance
  double friction = 0;      // for mating surfaces and parts; less than their friction
  double pad_friction = 0;  // for the gripper's pads; less than their friction

  bool operator==(const Tolerances&) const = default;
};

}  // namespace assay::domain
