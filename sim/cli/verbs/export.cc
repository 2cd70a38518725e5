#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "planner/assembly/contingent_assembly.h"
#include "planner/contingent/grounding/grounding.h"
#include "planner/contingent/pks_and_pddl/pddl_text.h"
#include "planner/contingent/pks_and_pddl/pks_text.h"
#include "planner/contingent/pks_and_pddl/task_file.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/file_format.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/cli/tasks/body_export.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/cli/tree_output/dot.h"
#include "sim/cli/tree_output/plan_tree_report.h"
#include "sim/execution/commands/command_file.h"
#include "sim/scene/mjcf.h"

namespace assay::cli {
namespace export_verb {

struct Options {
  std::filesystem::path input;
  std::filesystem::path output;
  domain::ModelPath models;
  bool mjcf = false;
  bool urdf = false;
  bool obj = false;
  bool mated = false;         // the two parts of the last mating, and not the whole scene
  double clearance_mm = 0.5;  // of the holes of a part file
  bool dot = false;
  bool network = false;
  bool contacts = false;
  bool commands = false;
  bool pks = false;
  std::filesystem::path pddl;  // a problem of the domain `input`
};

void Deliver(const std::string& text, const Options& options) {
  if (options.output.empty()) {
    Print(text);
  } else {
    WriteFile(options.output, text);
  }
}

// Exports the first world of a scenario. Programs that read the file simulate the model with the
// unmodified engine. This engine throws parts off a table that is a box, so the exported tables are
// endless planes.
ExitCode ExportMjcf(const Options& options) {
  const Document document = Document::Load(options.input);
  const domain::Problem first = scenario::ReadWorlds(document, options.models).front();
  scene::SceneOptions scene = scenario::ReadSimulation(document).scene;
  scene.endless_tables = true;
  Deliver(scene::ToMjcf(first, scene), options);
  return ExitCode::kDone;
}

bool IsPart(const std::filesystem::path& input) {
  return std::filesystem::is_directory(input) ||
         FormatOf(Document::Load(input)) == FileFormat::kPartFile;
}

ExitCode ExportParts(const Options& options) {
  using Format = BodyExport::Format;
  ExportBodies({.input = options.input,
                .output = options.output,
                .models = options.models,
                .format = options.urdf  ? Format::kUrdf
                          : options.obj ? Format::kObj
                                        : Format::kMjcf,
                .clearance_mm = options.clearance_mm});
  return ExitCode::kDone;
}

// Delivers the text that `write` makes of a plan, or reports why there is no plan.
ExitCode ExportPlan(const Options& options,
                    std::string (*write)(const domain::Problem&, const plan::Plan&)) {
  const PlannedProblem planned = ReadOrMakePlan(Document::Load(options.input), options.models);
  RequireSound(planned);
  if (planned.result.outcome == Outcome::kFound) {
    Deliver(write(planned.problem, planned.result.plan), options);
  } else {
    Print(Text(planned.problem, planned.result));
  }
  return ExitCodeOf(planned.result.outcome);
}

std::string CommandFileText(const domain::Problem& problem, const plan::Plan& plan) {
  return execution::Text(problem, plan, execution::CommandFileOf(problem, plan));
}

ExitCode ExportNetwork(const Options& options) {
  const scenario::Scenario scenario = scenario::Load(options.input, options.models);
  std::string dot;
  const auto show = [&](const constraint_posting::PartialPlan& plan) {
    dot = ConstraintNetworkToDot(plan);
  };
  const plan::PlanResult result =
      constraint_posting::MakePlan(scenario.problem, {.show_family = show});
  if (result.outcome == Outcome::kFound) {
    Deliver(dot, options);
  } else {
    Print(Text(scenario.problem, result));
  }
  return ExitCodeOf(result.outcome);
}

ExitCode ExportContacts(const Options& options) {
  const scenario::Scenario scenario = scenario::Load(options.input, options.models);
  const domain::Problem& problem = scenario.problem;
  if (problem.matings.empty()) {
    throw UsageError(fmt::format("export: {}: no goal mates parts", options.input.string()));
  }
  const finemotion::MatingGeometry geometry =
      finemotion::GeometryOf(problem, problem.matings.back());
  const std::string text = [&] {
    const Progress progress("looking for contact states");
    return ContactChainToDot(problem.name, ContactChainOf(geometry));
  }();
  Deliver(text, options);
  return ExitCode::kDone;
}

// Writes two files beside each other, NAME-domain.pddl and NAME-problem.pddl, or prints both.
ExitCode ExportPddl(const Options& options) {
  const contingent::Task task = contingent::LoadTask(options.input, options.pddl);
  contingent::Externs externs;
  const contingent::PddlFiles files =
      contingent::ToPddl(contingent::Ground(task.domain, task.problem, externs), task.problem.name);
  if (options.output.empty()) {
    Print(files.domain + files.problem);
  } else {
    WriteFile(options.output.string() + "-domain.pddl", files.domain);
    WriteFile(options.output.string() + "-problem.pddl", files.problem);
  }
  return ExitCode::kDone;
}

// Writes or prints the task that `assay contingent` would plan with, as NAME-domain.pks and
// NAME-problem.pks.
ExitCode ExportPks(const Options& options) {
  const std::vector<domain::Problem> worlds =
      ReadWorldsToPlan(Document::Load(options.input), options.models);
  const assembly::ContingentAssembly assembly = assembly::MakeContingentPlan(worlds, {}, {});
  const auto& [domain, problem, task, actions, names] = assembly.knowledge;
  const std::string about = fmt::format(
      "# What is known while plans for the scenario {} are executed.\n", worlds.front().name);
  if (domain.name.empty()) {
    Print(Text(worlds, assembly));
  } else if (options.output.empty()) {
    Print(about + TextOf(domain) + "\n" + TextOf(problem));
  } else {
    WriteFile(options.output.string() + "-domain.pks", about + TextOf(domain));
    WriteFile(options.output.string() + "-problem.pks", TextOf(problem));
  }
  return ExitCodeOf(assembly.outcome);
}

// Together with an option that names a graph, --dot adds nothing.
void RequireOneThing(const Options& options) {
  const bool names_graph = options.contacts || options.network;
  const int things = (options.dot && !names_graph) + options.mjcf + options.urdf + options.obj +
                     options.network + options.contacts + options.commands + !options.pddl.empty() +
                     options.pks;
  if (things != 1)
    throw UsageError(
        "export: only one of these options is allowed at a time (see assay export --help)");
  if (options.mated && !options.mjcf && !options.urdf && !options.obj) {
    throw UsageError("export: --mated needs one of --mjcf, --urdf, --obj");
  }
}

// The graphs and commands of a plan, and tasks of contingent planning.
void AddPlanOptions(CLI::Option_group& what, Options& options) {
  what.add_flag("--dot", options.dot,
                "the plan's ordering graph for Graphviz; may also be given with --contacts or "
                "--network, and then changes nothing");
  what.add_flag("--network", options.network, "the plan's constraint network for Graphviz");
  what.add_flag(
      "--contacts", options.contacts,
      "the contact states of the last mating at all of its critical points, for Graphviz");
  what.add_flag("--commands", options.commands,
                "the commands to the robot, in the order of execution");
  what.add_option("--pddl", options.pddl, "a .pks domain and this problem, as contingent PDDL");
  what.add_flag("--pks", options.pks,
                "the knowledge in the scenario's plans (looks, verifications and recoveries), as "
                "a domain and a problem for assay contingent");
}

void AddShapeOptions(CLI::Option_group& what, Options& options) {
  what.add_flag("--mjcf", options.mjcf,
                "the scene as a model for MuJoCo, with the key frame home; a part whose pose is "
                "open has its first pose. Of a part file: the part");
  what.add_flag("--urdf", options.urdf,
                "a part, or the parts of a mating, as URDF with convex pieces");
  what.add_flag("--obj", options.obj,
                "a part, or the parts of a mating, as OBJ with convex pieces");
}

ExitCode Execute(const Options& options) {
  RequireOneThing(options);
  if (!options.pddl.empty()) return ExportPddl(options);
  if (options.pks) return ExportPks(options);
  RequireWritable(options.output);
  const bool is_of_parts = options.mated || options.urdf || options.obj;
  if (is_of_parts || (options.mjcf && IsPart(options.input))) return ExportParts(options);
  if (options.mjcf) return ExportMjcf(options);
  if (options.contacts) return ExportContacts(options);
  if (options.network) return ExportNetwork(options);
  return ExportPlan(options, options.dot ? OrderingGraphToDot : CommandFileText);
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("input", options->input,
                  "scenario file; for --dot and --commands also a plan file; for --pddl a domain; "
                  "for --mjcf, --urdf and --obj also a part file or the folder of a part")
      ->required();
  CLI::Option_group* const what = command.add_option_group("what");
  AddShapeOptions(*what, *options);
  AddPlanOptions(*what, *options);
  what->require_option(1, 2);
  command.add_flag("--mated", options->mated,
                   "the two parts of the scenario's last mating in their mated pose, with the play "
                   "of the shaft as measured in the engine; --urdf and --obj always export these");
  command
      .add_option("--clearance", options->clearance_mm,
                  "for a part file: clearance of the part's holes in mm")
      ->check(CLI::Range(0.0, 10.0))
      ->capture_default_str();
  command.add_option("-o,--output", options->output, "write to this file instead of printing");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace export_verb

const Verb kExport = {
    .name = "export",
    .summary =
        "writes the scene of a scenario, parts for other programs, graphs and commands of a plan, "
        "or a problem as PDDL",
    .page = "sim/running.md",
    .example =
        "assay export scenarios/spar-fig13.yaml --mjcf -o fig13.xml\n  assay export "
        "scenarios/mate-round.yaml --mated --mjcf -o pair.xml\n  assay export "
        "scenarios/know/force-sensing.pks --pddl scenarios/know/two-cans.pks -o cans\n\nThe last "
        "command writes cans-domain.pddl and cans-problem.pddl.",
    .declare = export_verb::Declare,
};

}  // namespace assay::cli
