#pragma once

#include <string>
#include <vector>

namespace assay::mujoco {

// Takes over the engine's error and warning handlers, whose defaults write MUJOCO_LOG.TXT into the
// working directory, and end the program on an error. From then on an engine error is a broken
// invariant: it stops the program with the engine's message (check.h). A warning is kept for the
// thread that caused it. Called by everything here that calls the engine; calling again is free.
void HandleEngineMessages();

// The warnings of the engine on this thread since the last call.
std::vector<std::string> TakeEngineWarnings();

}  // namespace assay::mujoco
