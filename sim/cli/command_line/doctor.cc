#include <fmt/format.h>
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "planner/base/input_files/input_error.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/plan_output/table.h"
#include "sim/film/ffmpeg.h"
#include "sim/render/renderer.h"

namespace assay::cli {
namespace doctor_verb {

using Json = nlohmann::ordered_json;

struct Options {
  bool json = false;
};

double MemoryInGigabytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)) /
         1e9;
}

std::string ModelsFolder() {
  try {
    return FindModelsHere({}).folders().back().string();
  } catch (const EnvironmentError&) {
    return "";
  }
}

Json Examine() {
  return {{"assay", ASSAY_VERSION},
          {"mujoco", mj_versionString()},
          {"mujoco_headers", mjVERSION_HEADER},
          {"renderer", render::AvailableRenderer()},
          {"ffmpeg", film::FindFfmpeg().string()},
          {"cores", std::thread::hardware_concurrency()},
          {"memory_gb", std::round(10 * MemoryInGigabytes()) / 10},
          {"compiler", __VERSION__},
          {"models", ModelsFolder()}};
}

// Returns remedies for the missing things. Missing models need no remedy, because a scenario has
// its own models. A missing ffmpeg needs none, because films can be made without it.
std::vector<std::string> Remedies(const Json& facts) {
  if (facts["renderer"] != "") return {};
  return {"no OpenGL renderer, so no pictures: apt-get install libosmesa6 (or libegl1)"};
}

std::string ForPeople(const Json& facts, const std::vector<std::string>& remedies) {
  Table table({{"what"}, {"found"}});
  for (const auto& [name, value] : facts.items()) {
    const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    table.Add({name, text.empty() ? "none" : text});
  }
  std::string text = table.Text();
  if (facts["ffmpeg"] == "") {
    text += "no ffmpeg, so films as .webp and not as .mp4: apt-get install ffmpeg\n";
  }
  for (const std::string& remedy : remedies) text += remedy + "\n";
  return text;
}

ExitCode Execute(const Options& options) {
  Json facts = Examine();
  const std::vector<std::string> remedies = Remedies(facts);
  if (options.json) {
    facts["missing"] = remedies;
    Print(plan::JsonText(facts));
  } else {
    Print(ForPeople(facts, remedies));
  }
  return remedies.empty() ? ExitCode::kDone : ExitCode::kEnvironment;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_flag("--json", options->json, "print as JSON");
  return [options] { return Execute(*options); };
}

}  // namespace doctor_verb

const Verb kDoctor = {
    .name = "doctor",
    .summary = "lists what the program found on this machine, and what to install",
    .page = "sim/running.md",
    .example = "assay doctor",
    .declare = doctor_verb::Declare,
};

}  // namespace assay::cli
