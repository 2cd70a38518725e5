#include "sim/scenario/scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "planner/base/input_files/document.h"
#include "planner/domain/units/units.h"
#include "sim/scenario/models_folder.h"

namespace assay::scenario {
namespace {

// Contacts are tuned for half a millisecond. Twice that is the longest timestep with which a held
// part slips by less than the usual clearances.
constexpr domain::Range kTimesteps = {1e-5, 0.001};

std::vector<std::string> ReadCameras(const Value& value) {
  static const std::vector<std::string> kCameras = {kWorkCamera, "overview", "close", "side",
                                                    "top"};
  std::vector<std::string> cameras;
  for (const Value& item : value.Items()) {
    const std::string& camera = kCameras[static_cast<std::size_t>(item.OneOf(kCameras))];
    if (std::ranges::find(cameras, camera) != cameras.end()) {
      item.Fail("the camera is given twice", "each camera once");
    }
    cameras.push_back(camera);
  }
  return cameras;
}

scene::GraspMode ReadGrasp(const Value& value) {
  return value.OneOf({"friction", "weld"}) == 0 ? scene::GraspMode::kFriction
                                                : scene::GraspMode::kWeld;
}

// Refuses open poses where a plan is made for one world. Only looks distinguish open poses, so a
// plan for them is a tree.
void RequireKnownPoses(const Document& document, const domain::Problem& problem,
                       const Overrides& overrides) {
  for (const domain::OpenPose& open : problem.open_poses) {
    const std::string& name = problem.part(open.part).name;
    if (overrides.poses.contains(name)) continue;
    document.root().At("parts").At(name).At("pose").Fail(
        fmt::format("the pose of '{}' is open, but this command needs exactly one world", name),
        "a pose; or assay plan and assay run, which make and execute a tree for all worlds");
  }
}

}  // namespace

Simulation ReadSimulation(const Document& document) {
  Simulation simulation{.cameras = {kWorkCamera, "overview"}};
  const std::optional<Value> map = document.root().Find("simulation");
  if (!map) return simulation;
  map->AllowOnly({"seed", "grasp", "timestep", "cameras"});
  if (const auto seed = map->Find("seed")) {
    simulation.seed = static_cast<std::uint64_t>(seed->Integer(0, std::numeric_limits<int>::max()));
  }
  if (const auto grasp = map->Find("grasp")) simulation.scene.grasp = ReadGrasp(*grasp);
  if (const auto timestep = map->Find("timestep")) {
    simulation.scene.timestep = domain::ReadWithin(*timestep, domain::kSeconds, kTimesteps);
  }
  if (const auto cameras = map->Find("cameras")) simulation.cameras = ReadCameras(*cameras);
  return simulation;
}

Scenario Read(const Document& document, const domain::ModelPath& models,
              const Overrides& overrides) {
  document.RequireFormat("assay-scenario/1");
  Simulation simulation = ReadSimulation(document);
  domain::Problem problem =
      domain::ReadProblem(document, FindModels(document.file(), models), overrides);
  RequireKnownPoses(document, problem, overrides);
  return {std::move(problem), std::move(simulation)};
}

Scenario Load(const std::filesystem::path& file, const domain::ModelPath& models,
              const Overrides& overrides) {
  return Read(Document::Load(file), models, overrides);
}

std::vector<domain::Problem> ReadWorlds(const Document& document, const domain::ModelPath& models,
                                        const Overrides& overrides) {
  ReadSimulation(document);  // throws if the key is wrong
  return domain::ReadWorlds(document, FindModels(document.file(), models), overrides);
}

}  // namespace assay::scenario
