#pragma once

namespace assay::mujoco {

// Puts a check behind the engine's collision of box with box, for the whole process; calling again
// is free. Where two faces are parallel to within rounding (tilts of 1e-13 rad and less: parts as
// they are placed, and parts that have come to rest), the engine (2.2.2) adds to the right contacts
// some that lie far outside of the boxes and are decimetres deep, which shoot the part away: in 7 %
// of the poses tilted by 1e-17 rad, in 1 % at 1e-15. A contact is kept if it lies in both boxes, to
// a tenth of a millimetre. This needs contacts without margin.
void CheckBoxCollisions();

}  // namespace assay::mujoco
