#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/domain/problem/problem_file.h"
#include "sim/scene/mjcf.h"

namespace assay::scenario {

// The camera that is none of the scene's: it shows the parts that are worked on and the hand,
// wherever they are.
inline constexpr const char* kWorkCamera = "work";

// What a scenario says about its simulation. The planner does not know it.
struct Simulation {
  std::uint64_t seed = 0;                 // of all that is random
  scene::SceneOptions scene = {};         // keys grasp and timestep
  std::vector<std::string> cameras = {};  // for pictures, in this order
};

// A scenario file as a whole.
struct Scenario {
  domain::Problem problem;
  Simulation simulation;
};

// Reads a scenario ("assay-scenario/1") with the models of FindModels, if none are given. Its key
// `simulation`: {seed: 0 or more, grasp: friction or weld, timestep: seconds, cameras: [names]},
// all of which may be left out. Throws InputError. Overrides are a sweep's: {.clearance: metres
// instead of the file's, .error_scale: a factor}.
using domain::Overrides;
Scenario Read(const Document& document, const domain::ModelPath& models = {},
              const Overrides& overrides = {});
// The same of a file.
Scenario Load(const std::filesystem::path& file, const domain::ModelPath& models = {},
              const Overrides& overrides = {});
// The problems alone, one for each world (domain::ReadWorlds). The others throw InputError if a
// pose is open.
std::vector<domain::Problem> ReadWorlds(const Document& document,
                                        const domain::ModelPath& models = {},
                                        const Overrides& overrides = {});
Simulation ReadSimulation(const Document& document);

}  // namespace assay::scenario
