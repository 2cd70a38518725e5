#pragma once

namespace assay::domain {

// How far quantities that hold for the whole problem may differ from their values in it: half
// widths of intervals about these values.
struct Tolerances {
  double clearance = 0;     // of a mated shaft on each side, metres; less than the clearance
  double friction = 0;      // of mating surfaces and of parts; less than their friction
  double pad_friction = 0;  // of the gripper's pads; less than their friction

  bool operator==(const Tolerances&) const = default;
};

}  // namespace assay::domain
