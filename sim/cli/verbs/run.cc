#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "planner/base/input_files/quotation.h"
#include "planner/plan/plan_files/json_layout.h"
#include "planner/plan/plan_files/plan_file.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/options/quantity_option.h"
#include "sim/cli/options/resolver_option.h"
#include "sim/cli/plan_output/certificate_text.h"
#include "sim/cli/plan_output/plan_report.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/cli/runs/contingent_run.h"
#include "sim/cli/runs/exact_run.h"
#include "sim/cli/runs/noisy_run.h"
#include "sim/cli/runs/scattered_run.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/sweep/shell_commands/run_command.h"

namespace assay::cli {
namespace run_verb {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

struct Options {
  sweep::RunCommand command;  // the options that decide what the trials do
  fs::path folder;            // empty: nothing is written
  std::optional<int> trials;
  int jobs = 1;
  PictureOptions pictures;
  bool renders = false;
  bool json = false;
  std::int64_t attempts = 1000;
  bool conservatism = false;
  std::vector<const CLI::Option*> of_one_world = {};  // options that plan trees do not have
  std::vector<const CLI::Option*> of_trees = {};
};

// Prints why nothing is executed.
ExitCode Refuse(const std::string& text, const Json& json, const Options& options, ExitCode code) {
  Print(options.json ? plan::JsonText(json) : text);
  return code;
}

ExitCode ExecuteScattered(const Options& options) {
  const sweep::RunCommand& command = options.command;
  scenario::Scenario scenario = scenario::Load(command.input, command.models);
  scenario.simulation.scene.grasp = command.grasp.value_or(scenario.simulation.scene.grasp);
  return RunScattered({.command = command,
                       .folder = options.folder,
                       .trials = options.trials.value_or(1),
                       .jobs = options.jobs,
                       .seed = command.seed.value_or(scenario.simulation.seed),
                       .json = options.json},
                      scenario);
}

bool ChangesThePlan(const sweep::RunCommand& command) {
  return command.propagation != "sound" || command.error_scale != 1 || !command.resolvers.empty();
}

PlannedProblem Planned(const Document& document, const sweep::RunCommand& command) {
  if (!ChangesThePlan(command)) return ReadOrMakePlan(document, command.models);
  if (IsPlanFile(document)) {
    throw UsageError(
        "run: --propagation, --resolvers and --error-scale are for scenarios: a plan file has been "
        "planned already");
  }
  constraint_posting::UncertaintyOptions uncertainty;
  if (command.propagation == "paper") uncertainty.propagation = uncertainty::Propagation::kPaper;
  scenario::Overrides overrides;
  overrides.error_scale = command.error_scale;
  overrides.resolvers = ResolversFrom(command.resolvers);
  return MakePlan(document, scenario::Read(document, command.models, overrides), {}, uncertainty);
}

ExitCode ExecutePlan(const Options& options, PlannedProblem& planned) {
  const sweep::RunCommand& command = options.command;
  planned.simulation.scene.grasp = command.grasp.value_or(planned.simulation.scene.grasp);
  const std::uint64_t seed = command.seed.value_or(planned.simulation.seed);
  if (!command.noise && !command.errors) {
    return RunExact({.planned = planned,
                     .command = command,
                     .folder = options.folder,
                     .trials = options.trials.value_or(1),
                     .jobs = options.jobs,
                     .seed = seed,
                     .renders = options.renders,
                     .pictures = options.pictures,
                     .json = options.json});
  }
  if (command.noise == "attack") {
    return RunFalsification({.planned = planned,
                             .command = command,
                             .folder = options.folder,
                             .attempts = options.attempts,
                             .jobs = options.jobs,
                             .seed = seed,
                             .conservatism = options.conservatism,
                             .json = options.json});
  }
  const auto& names = noise::ModeNames();
  const auto mode = std::ranges::find(names, command.noise.value_or("none")) - names.begin();
  return RunNoisy({.planned = planned,
                   .command = command,
                   .folder = options.folder,
                   .mode = static_cast<noise::Mode>(mode),
                   .trials = options.trials.value_or(1),
                   .jobs = options.jobs,
                   .seed = seed,
                   .json = options.json});
}

// Writes the plan, unless it was read from the same file.
void KeepPlan(const PlannedProblem& planned, const Json& plan_file, const Options& options) {
  if (options.folder.empty()) return;
  const fs::path file = options.folder / "plan.json";
  std::error_code ignored;
  if (!planned.plan_file.empty() && fs::equivalent(planned.plan_file, file, ignored)) return;
  WriteFile(file, plan::LaidOut(plan_file));
}

// Refuses options that have no meaning for the input.
void RefuseOptions(const std::vector<const CLI::Option*>& refused, const std::string& reason) {
  for (const CLI::Option* option : refused) {
    if (option->count() == 0) continue;
    throw UsageError(fmt::format("run: {} {} (see assay run --help)", option->get_name(), reason));
  }
}

ExitCode ExecuteTree(const Options& options) {
  RefuseOptions(options.of_one_world,
                fmt::format("is for plans without branches, and the plan for {} is a tree",
                            Quote(options.command.input.string())));
  return RunContingent({.command = options.command,
                        .trials = options.trials,
                        .folder = options.folder,
                        .jobs = options.jobs,
                        .renders = options.renders,
                        .pictures = options.pictures,
                        .json = options.json});
}

ExitCode Execute(const Options& options) {
  if (!options.folder.empty()) MakeFolder(options.folder);
  if (options.command.scatter) return ExecuteScattered(options);
  const Document document = Document::Load(options.command.input);
  if (!IsPlanFile(document) && (options.command.tree || execution::NeedsATree(document))) {
    return ExecuteTree(options);
  }
  RefuseOptions(options.of_trees, "is for plan trees; --tree makes one from any scenario");
  PlannedProblem planned = Planned(document, options.command);
  const plan::PlanResult& result = planned.result;
  Json plan_file = plan::ToJson(result, planned.problem, planned.scenario);
  KeepPlan(planned, plan_file, options);
  if (result.outcome != Outcome::kFound) {
    return Refuse(Text(planned.problem, result), plan_file, options, ExitCodeOf(result.outcome));
  }
  // Wrong errors are refused before the work that takes time.
  if (options.command.errors) NoiseFrom(*options.command.errors, planned);
  const plan::CheckReport check =
      planned.plan_file.empty() ? CheckPlan(planned.problem, result.plan) : CheckPlan(planned);
  if (!check.flaws.empty()) {
    plan_file["check"] = ToJson(result.plan, check);
    return Refuse(Text(result.plan, check), plan_file, options, ExitCode::kFailed);
  }
  return ExecutePlan(options, planned);
}

void AddNoise(CLI::App& command, Options& options, CLI::Option* scatter) {
  std::vector<std::string> modes = noise::ModeNames();
  modes.push_back("attack");
  CLI::Option* const noise =
      command
          .add_option("--noise", options.command.noise,
                      "how errors are drawn within the bounds that the planner assumes; attack "
                      "searches for errors that violate the certificates")
          ->check(CLI::IsMember(modes))
          ->excludes(scatter);
  options.of_one_world = {
      noise,
      command
          .add_option("--errors", options.command.errors,
                      "run one trial with these errors, in metres and radians: 'dx_block=0.002 "
                      "theta_hand@action_2=-0.001'")
          ->excludes(noise)
          ->excludes(scatter),
      command
          .add_option("--sensing", options.command.sensing,
                      "drawn: the noise gives the error of each look, within the sensor's promise; "
                      "camera: looks measure the parts in rendered pictures")
          ->check(CLI::IsMember({"drawn", "camera"})),
      command
          .add_option("--attempts", options.attempts,
                      "number of attempts of --noise attack; each attempt executes one step")
          ->check(CLI::Range(std::int64_t{1}, std::numeric_limits<std::int64_t>::max())),
      command.add_flag(
          "--conservatism", options.conservatism,
          "with --noise attack: measure how much more error than guaranteed makes the plan fail"),
      command
          .add_option("--propagation", options.command.propagation,
                      "how errors pass from step to step in planning: sound (correct for all "
                      "errors, the default) or paper (as published)")
          ->check(CLI::IsMember({"sound", "paper"})),
      AddResolvers(command, options.command.resolvers)->excludes(scatter),
      command
          .add_option("--error-scale", options.command.error_scale,
                      "factor by which all error bounds are multiplied, in planning too")
          ->check(Within(domain::kAtLeastZero, domain::kRatio))};
}

void AddTrees(CLI::App& command, Options& options, CLI::Option* scatter) {
  command
      .add_flag("--tree", options.command.tree,
                "execute the plan as a tree: verifications branch, recoveries repeat. Plans that "
                "need a tree are trees without this option")
      ->excludes(scatter);
  options.of_trees = {
      command
          .add_option("--worlds", options.command.worlds,
                      "for a plan tree: drawn: hidden facts are drawn; all: the trials go through "
                      "the leaves and repeats of the tree in turn")
          ->check(CLI::IsMember({"drawn", "all"}))
          ->capture_default_str(),
      command
          .add_option("--sensing-errors", options.command.sensing_errors,
                      "for a plan tree: probability with which an observation is made wrong")
          ->check(Within({0, 1}, domain::kRatio))};
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("input", options->command.input, "scenario file, or plan file")->required();
  CLI::Option* const folder =
      command.add_option("-o,--output", options->folder,
                         "folder for plan.json, trace.jsonl, result.json and pictures");
  command
      .add_option("--trials", options->trials,
                  "number of trials: 1 if left out, or with --worlds all one for each leaf")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_option("--jobs", options->jobs, "number of threads")->check(CLI::Range(1, 1024));
  command.add_option("--seed", options->command.seed,
                     "seed of all random numbers; the scenario's seed if left out");
  static const std::map<std::string, scene::GraspMode> kGraspModes = {
      {"friction", scene::GraspMode::kFriction}, {"weld", scene::GraspMode::kWeld}};
  CLI::Option* const grasp = command
                                 .add_option("--grasp", options->command.grasp,
                                             "how the gripper holds parts: friction or weld")
                                 ->transform(CLI::CheckedTransformer(kGraspModes));
  command.add_option("--trial", options->command.trial, "run only the trial with this number")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command
      .add_flag("--renders", options->renders,
                "take pictures of the start, each step's end, and grasps and matings on the way")
      ->needs(folder);
  AddPictureOptions(command, options->pictures, "--renders");
  CLI::Option* const scatter =
      command.add_flag("--scatter", options->command.scatter,
                       "in each trial, put the parts at other random places and make a new plan");
  AddNoise(command, *options, scatter);
  options->of_one_world.push_back(grasp);
  AddTrees(command, *options, scatter);
  command.add_flag("--json", options->json, "print the result as JSON");
  AddModelsOption(command, options->command.models);
  return [options] { return Execute(*options); };
}

}  // namespace run_verb

const Verb kRun = {
    .name = "run",
    .summary = "executes a plan or a plan tree in physics, and judges the result",
    .page = "sim/running.md",
    .example =
        "assay run scenarios/spar-fig13.yaml --renders -o out/fig13\n"
        "  assay run scenarios/two-cans.yaml --worlds all",
    .declare = run_verb::Declare,
};

}  // namespace assay::cli
