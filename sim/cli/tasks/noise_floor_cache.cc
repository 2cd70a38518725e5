#include "sim/cli/tasks/noise_floor_cache.h"

#include <mujoco/mujoco.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "planner/base/digest.h"
#include "planner/base/input_files/input_error.h"
#include "planner/base/module.h"
#include "planner/base/stop.h"
#include "planner/plan/plan_files/json_layout.h"
#include "planner/plan/plan_files/plan_file.h"
#include "sim/check/noise_floor/measure_noise_floor.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/scene/mjcf.h"

namespace assay::cli {
namespace {

namespace fs = std::filesystem;
using check::ClaimNoiseFloor;
using check::NoiseFloor;
using check::StepNoiseFloor;
using Json = nlohmann::ordered_json;

// Returns an empty path if there is no cache folder.
fs::path CacheFolder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/') {
    return fs::path(cache) / "assay" / "noise-floor";
  }
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home != '/') return {};
  return fs::path(home) / ".cache" / "assay" / "noise-floor";
}

std::string BytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string KeyOf(const domain::Problem& problem, const plan::Plan& plan,
                  const scene::SceneOptions& scene) {
  static const std::string program = Digest().Add(BytesOf(FileOfThisCode())).Hex();
  plan::PlanResult result;
  result.plan = plan;
  return Digest()
      .Add(program)
      .Add(mj_versionString())
      .Add(problem.origin)
      .Add(plan::JsonLine(plan::ToJson(result, problem, "")))
      .Add(scene::ToMjcf(problem, scene))
      .Hex();
}

Json FloorToJson(const NoiseFloor& floor) {
  Json steps = Json::array();
  for (const StepNoiseFloor& step : floor.steps) {
    Json components = Json::array();
    for (const ClaimNoiseFloor& component : step.components) {
      components.push_back({static_cast<int>(component.about), component.name, component.offset,
                            component.step_size});
    }
    steps.push_back({components, step.arm, step.penetration, step.lag, step.lag_turn});
  }
  return steps;
}

NoiseFloor FloorFromJson(const Json& steps) {
  NoiseFloor floor;
  for (const Json& step : steps) {
    StepNoiseFloor& read = floor.steps.emplace_back(StepNoiseFloor{
        .arm = step.at(1), .penetration = step.at(2), .lag = step.at(3), .lag_turn = step.at(4)});
    for (const Json& component : step.at(0)) {
      read.components.push_back({static_cast<check::Claimed>(component.at(0).get<int>()),
                                 component.at(1), component.at(2), component.at(3)});
    }
  }
  return floor;
}

// Reads a floor that this program wrote. A file that was damaged on the disk is ignored.
std::optional<NoiseFloor> Kept(const fs::path& file, std::size_t steps) {
  const std::string text = BytesOf(file);
  if (text.empty()) return std::nullopt;
  try {
    NoiseFloor floor = FloorFromJson(Json::parse(text));
    if (floor.steps.size() == steps) return floor;
  } catch (const Json::exception&) {
  }
  return std::nullopt;
}

void Keep(const NoiseFloor& floor, const fs::path& file) {
  try {
    MakeFolder(file.parent_path());
    WriteFile(file, plan::JsonLine(FloorToJson(floor)) + "\n");
  } catch (const EnvironmentError&) {
    // The floor is measured again the next time.
  }
}

}  // namespace

NoiseFloor KeptNoiseFloor(const domain::Problem& problem, const plan::Plan& plan,
                          const scene::SceneOptions& scene) {
  const fs::path folder = CacheFolder();
  const auto measured = [&] { return check::MeasureNoiseFloor(problem, plan, scene); };
  if (folder.empty() || problem.origin.empty()) return measured();
  const fs::path file = folder / (KeyOf(problem, plan, scene) + ".json");
  if (std::optional<NoiseFloor> kept = Kept(file, plan.steps.size())) return std::move(*kept);
  NoiseFloor floor = measured();
  Keep(floor, file);
  return floor;
}

bool TakeNoiseFloor(check::Experiment& experiment) {
  try {
    experiment.gate = KeptNoiseFloor(experiment.problem, experiment.plan, experiment.scene);
    return true;
  } catch (const Stopped&) {
    return false;
  }
}

}  // namespace assay::cli
