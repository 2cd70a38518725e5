#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "planner/assembly/contingent_assembly.h"
#include "planner/base/input_files/input_error.h"
#include "planner/base/stop.h"
#include "planner/domain/parts/part_file.h"
#include "planner/domain/workcell/workcell_file.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/file_format.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/options/quantity_option.h"
#include "sim/cli/plan_output/arm_report.h"
#include "sim/cli/plan_output/part_report.h"
#include "sim/cli/plan_output/plan_report.h"
#include "sim/cli/plan_output/problem_report.h"
#include "sim/cli/plan_output/workcell_report.h"
#include "sim/cli/sweep_output/sweep_report.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/execution/interpretation/interpretation.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {
namespace check_verb {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Options {
  std::vector<fs::path> files;
  domain::ModelPath models;
  fs::path output;
  std::string workcell = "puma762-table";  // the workcell whose gripper takes a part
  double clearance_mm = 0.5;               // clearance of a part's holes
  ArmRequest arm;                          // of a robot's file; without its name
  bool json = false;
};

Report CheckPart(const Document& document, const fs::path& file, const Options& options) {
  const auto part = domain::PartFile::Read(document, options.clearance_mm / 1000);
  const auto workcell = domain::WorkcellFile::Read(
      scenario::FindModels(file, options.models).WorkcellFile(options.workcell));
  const kinematics::Gripper& gripper = workcell->gripper();
  return ReportOn(*part,
                  domain::ComputeGrasps(*part, gripper,
                                        {workcell->rules().approach_step, gripper.max_opening()}));
}

// A scenario's key `knowledge` does not appear in the report, but is checked.
Report CheckScenario(const Document& document, const fs::path& file, const Options& options) {
  if (document.root().Find("knowledge")) {
    execution::Read(document, scenario::FindModels(file, options.models));
  }
  const std::vector<domain::Problem> worlds = scenario::ReadWorlds(document, options.models);
  Report report = ReportOn(worlds.front());
  if (worlds.size() == 1) return report;
  std::vector<std::string> names;
  for (const domain::Problem& world : worlds) names.push_back(assembly::NameOf(world));
  Json json = *report.json;
  json["worlds"] = names;
  report.json = std::make_shared<const Json>(std::move(json));
  report.text += fmt::format("worlds: {} (this is the first)\n", fmt::join(names, "; "));
  return report;
}

Report CheckArm(const fs::path& file, const Options& options) {
  ArmRequest request = options.arm;
  request.file = file;
  return ReportOnArm(request);
}

Report CheckFile(const fs::path& file, const Options& options) {
  if (file.extension() == ".urdf") return CheckArm(file, options);
  const Document document = Document::Load(file);
  switch (FormatOf(document)) {
    case FileFormat::kScenarioFile:
      return CheckScenario(document, file, options);
    case FileFormat::kPartFile:
      return CheckPart(document, file, options);
    case FileFormat::kWorkcellFile:
      return ReportOn(*domain::WorkcellFile::Read(file));
    case FileFormat::kPlanFile:
      return ReportOn(ReadPlan(document, options.models));
    case FileFormat::kSweepFile:
      return ReportOn(sweep::Load(file), options.models);
  }
  return {};
}

// Collects the reports on all files. An error in one file does not stop the others from being
// checked.
struct Summary {
  Json files = Json::array();
  std::string text;
  bool all_right = true;  // no file has an error in its input
  bool all_hold = true;

  void Add(const fs::path& file, const Options& options) {
    try {
      const Progress progress("checking " + file.string());
      Report report = CheckFile(file, options);
      Json json = {{"file", file.string()}, {"holds", report.holds}};
      json.update(*report.json);
      files.push_back(std::move(json));
      text += (text.empty() ? "" : "\n") + report.text;
      all_hold = all_hold && report.holds;
    } catch (const InputError& error) {
      PrintError(error.what());
      files.push_back({{"file", file.string()}, {"holds", false}, {"error", error.what()}});
      all_right = false;
    } catch (const Stopped&) {
      // An interruption came before the answer about this file.
    }
  }
};

ExitCode Execute(const Options& options) {
  RequireWritable(options.output);
  // If a signal ends the check of a single file, there is no result to keep.
  std::optional<Interruption> interruption;
  if (options.files.size() > 1) interruption.emplace();
  Summary summary;
  for (const fs::path& file : options.files) {
    if (!Interruption::Requested()) summary.Add(file, options);
  }
  const std::string interrupted = Interruption::Text(
      std::ssize(summary.files), std::ssize(options.files), "files were checked");
  Json result = {{"files", summary.files}};
  if (!interrupted.empty()) result["interrupted"] = true;
  const std::string json = plan::JsonText(result);
  PrintAndWrite(options.json ? json : summary.text + interrupted, [&] {
    if (!options.output.empty()) WriteFile(options.output, json);
  });
  if (!summary.all_right) return ExitCode::kWrongInput;
  return Interruption::CodeOr(summary.all_hold ? ExitCode::kDone : ExitCode::kFailed);
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("file", options->files,
                  "scenario, sweep, part, workcell and plan files, and URDF files of arms")
      ->required();
  command.add_flag("--json", options->json, "print the reports as JSON");
  command.add_option("-o,--output", options->output, "write the reports, as JSON, to this file");
  command
      .add_option("--workcell", options->workcell,
                  "for a part file: workcell whose gripper takes the part")
      ->capture_default_str();
  command
      .add_option("--clearance", options->clearance_mm,
                  "for a part file: clearance of the part's holes in mm")
      ->check(Within({0, 0.01}, domain::kMillimetres))
      ->capture_default_str();
  command.add_option("--base", options->arm.base, "for a URDF file: link at which the arm begins");
  command.add_option("--tip", options->arm.tip, "for a URDF file: link at which the arm ends");
  command.add_option("--packages", options->arm.packages,
                     "for a URDF file: folders in which packages with its meshes lie");
  command.add_option("--poses", options->arm.poses, "for a URDF file: random postures to solve")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command.add_option("--seed", options->arm.seed, "for a URDF file: seed of the postures")
      ->capture_default_str();
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace check_verb

const Verb kCheck = {
    .name = "check",
    .summary =
        "checks scenario, sweep, part, workcell and plan files, and arms, and reports what it "
        "computes "
        "from them",
    .page = "scenarios/scenario-files.md",
    .example = "assay check scenarios/spar-fig13.yaml models/parts/block/part.yaml",
    .declare = check_verb::Declare,
};

}  // namespace assay::cli
