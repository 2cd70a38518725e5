#pragma once

namespace assay::mujoco {

// Adds a check after the engine's collision of box with box, for the whole process. More calls have
// no effect. The check gives all contacts half of the depth to which the boxes are in each other:
// the engine gives half of the depth for most contacts, and all of it for some. The check leaves
// out three kinds of contacts.
//
// Wrong contacts: an edge of one box may be parallel to a face of the other to within rounding, for
// parts as they are placed or parts that have come to rest. In 3 to 7 % of these poses the engine
// (2.2.2) adds contacts that lie far outside of the boxes and are decimetres deep, which shoot the
// part away. A contact is kept if it lies in both boxes, to a tenth of a millimetre. This needs
// contacts without margin.
//
// Contacts inside a body: pieces of one body may meet flush. A part that slides over them and sinks
// in by a micrometre can be stopped by the end of the next piece, although this end is inside the
// body. Contacts on faces that lie against another piece are left out.
//
// Repeated contacts: where pieces of one body meet, each piece has the same contact with another
// body. Only the first contact at one place with one normal is kept, which saves the solver a fifth
// of its work.
void CheckBoxCollisions();

}  // namespace assay::mujoco
