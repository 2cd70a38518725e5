#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "planner/base/stop.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/picture_output/step_pictures.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"

namespace assay::cli {
namespace render_verb {

using Json = nlohmann::ordered_json;

struct Options {
  std::filesystem::path input;
  std::filesystem::path folder;
  domain::ModelPath models;
  PictureOptions pictures;
  bool json = false;
};

// Executes the plan. Returns how the execution ended, or nothing if it was interrupted.
std::optional<execution::ExecutionEnd> Execute(const PlannedProblem& planned,
                                               const scene::Scene& scene, StepPictures& pictures) {
  const Progress progress("executing the plan for " + planned.problem.name);
  try {
    return check::RunTrial(planned.problem, planned.result.plan, scene, {.observer = &pictures})
        .trace.end();
  } catch (const Stopped&) {
    return std::nullopt;
  }
}

Json ToJson(const StepPictures& pictures, const std::optional<execution::ExecutionEnd>& end) {
  Json json = {{"pictures", pictures.FileNames()}};
  if (end) {
    json["outcome"] = NameOfEnd(end->outcome);
    json["reason"] = end->reason;
  } else {
    json["interrupted"] = true;
  }
  return json;
}

std::string ForPeople(const StepPictures& pictures,
                      const std::optional<execution::ExecutionEnd>& end) {
  std::string text = fmt::format("{}\n", fmt::join(pictures.FileNames(), "\n"));
  if (!end) return text + "interrupted: later pictures were not taken\n";
  if (end->outcome != execution::TrialOutcome::kSucceeded) {
    text +=
        fmt::format("the execution ended early: {}: {}\n", NameOfEnd(end->outcome), end->reason);
  }
  return text;
}

ExitCode Execute(const Options& options) {
  MakeFolder(options.folder);
  const PlannedProblem planned = ReadOrMakePlan(Document::Load(options.input), options.models);
  if (planned.result.outcome != Outcome::kFound) {
    Print(Text(planned.problem, planned.result));
    return ExitCodeOf(planned.result.outcome);
  }
  const scene::Scene scene(planned.problem, planned.simulation.scene);
  StepPictures pictures({planned.problem, planned.result.plan, scene}, planned.simulation.cameras,
                        options.pictures);
  const Interruption interruption;
  const std::optional<execution::ExecutionEnd> end = Execute(planned, scene, pictures);
  pictures.Write(options.folder);
  Print(options.json ? plan::JsonText(ToJson(pictures, end)) : ForPeople(pictures, end));
  const bool done = end && end->outcome == execution::TrialOutcome::kSucceeded;
  return Interruption::CodeOr(done ? ExitCode::kDone : ExitCode::kFailed);
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("input", options->input, "scenario file, or plan file")->required();
  command.add_option("-o,--output", options->folder, "folder for the pictures")->required();
  AddPictureOptions(command, options->pictures);
  command.add_flag("--json", options->json, "print the pictures' names as JSON");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace render_verb

const Verb kRender = {
    .name = "render",
    .summary =
        "takes pictures of the start, of every step's end, and of grasps and matings on the way",
    .page = "renders/README.md",
    .example = "assay render scenarios/spar-fig13.yaml -o out/fig13 --camera close --size 640x480",
    .declare = render_verb::Declare,
};

}  // namespace assay::cli
