#pragma once

namespace assay::mujoco {

// Replaces the engine's collisions of mesh with plane, box and mesh, for the whole process. More
// calls have no effect. The engine (2.2.2) finds one point for two meshes, and it jitters, so that
// parts creep and drop. Here the contacts are those of ContactsOfBodies (body_contacts.h). Their
// distance is half of the separation, as mostly in the engine's collision of boxes. This is so
// while CollidingPieces lives on the thread. Otherwise the engine's own functions decide.
void ReplaceMeshCollisions();

}  // namespace assay::mujoco
