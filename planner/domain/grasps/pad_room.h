#pragma once

namespace assay::domain {

// The room that the pads need, and the room that is available on the faces that they touch, in the
// direction in which room is scarcest. Both are in metres, and both are 0 if the pads fit.
struct PadRoom {
  double needed = 0;
  double available = 0;

  bool fits() const { return needed <= available; }
};

}  // namespace assay::domain
