#pragma once

namespace assay::mujoco {

// Replaces the engine's collisions of mesh with plane, box and mesh, for the whole process. More
// calls have no effect. The engine (2.2.2) finds one point for two meshes. This point jitters, so
// that parts creep and drop. The contacts of the replacement are those of ContactsOfBodies
// (body_contacts.h). Their distance is half of the separation, as mostly in the engine's collision
// of boxes. The replacement works while an object of CollidingPieces lives on the thread. At other
// times the engine's own functions find the contacts.
void ReplaceMeshCollisions();

}  // namespace assay::mujoco
