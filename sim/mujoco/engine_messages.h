#pragma once

#include <string>
#include <vector>

namespace assay::mujoco {

// Replaces the engine's error and warning handlers. The default handlers write MUJOCO_LOG.TXT into
// the working directory, and end the program on an error. With the new ones, an engine error is a
// broken invariant: it stops the program with the engine's message (check.h). A warning is kept for
// the thread that caused it. All code here that calls the engine calls this first; more calls have
// no effect.
void HandleEngineMessages();

// Returns the engine's warnings on this thread since the last call.
std::vector<std::string> TakeEngineWarnings();

}  // namespace assay::mujoco
