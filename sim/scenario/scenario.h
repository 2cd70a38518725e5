#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/domain/problem/problem_file.h"
#include "sim/scene/mjcf.h"

namespace assay::scenario {

// The name of the camera that follows the hand and the parts that are worked on. The scene has no
// camera of this name.
inline constexpr const char* kWorkCamera = "work";

// A scenario's settings for its simulation, which the planner does not know.
struct Simulation {
  std::uint64_t seed = 0;                 // of all random streams
  scene::SceneOptions scene = {};         // from the keys grasp and timestep
  std::vector<std::string> cameras = {};  // for pictures, in this order
};

// The content of a scenario file.
struct Scenario {
  domain::Problem problem;
  Simulation simulation;
};

// Reads a scenario ("assay-scenario/1"). `models` are the given folders for FindModels. The key
// `simulation` has the form {seed: 0 or more, grasp: friction or weld, timestep: seconds, cameras:
// [names]}; each of its keys may be left out. `overrides` come from a sweep: {.clearance: metres
// instead of the file's, .error_scale: a factor}. Throws InputError, also if a pose is open.
using domain::Overrides;
Scenario Read(const Document& document, const domain::ModelPath& models = {},
              const Overrides& overrides = {});
// Reads a scenario from a file, as Read does.
Scenario Load(const std::filesystem::path& file, const domain::ModelPath& models = {},
              const Overrides& overrides = {});
// Reads only the problems, one for each world (domain::ReadWorlds). Open poses are allowed. Throws
// InputError.
std::vector<domain::Problem> ReadWorlds(const Document& document,
                                        const domain::ModelPath& models = {},
                                        const Overrides& overrides = {});
// Reads the key `simulation` alone. Throws InputError.
Simulation ReadSimulation(const Document& document);

}  // namespace assay::scenario
