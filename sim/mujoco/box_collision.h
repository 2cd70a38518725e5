#pragma once

namespace assay::mujoco {

// Puts a check behind the engine's collision of box with box, for the whole process; calling again
// is free. Where an edge of one box is parallel to a face of the other to within rounding (parts as
// they are placed, parts that have come to rest), the engine (2.2.2) adds to the right contacts, in
// 3 to 7 % of such poses, some that lie far outside of the boxes and are decimetres deep, which
// shoot the part away. A contact is kept if it lies in both boxes, to a tenth of a millimetre. This
// needs contacts without margin.
//
// Where pieces of one body meet flush, what slides over them and sinks in by a micrometre can be
// stopped by the next piece's end, which is inside of the body. Contacts on faces that lie against
// another piece are left out.
//
// Where pieces of one body meet, each of them has the same contact with another body; of contacts
// at one place with one normal only the first is kept, which spares the solver a fifth of its work.
void CheckBoxCollisions();

}  // namespace assay::mujoco
