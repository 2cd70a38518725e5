#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "planner/assembly/contingent_assembly.h"
#include "planner/base/input_files/quotation.h"
#include "planner/budget/error_quantity.h"
#include "planner/plan/plan_files/json_layout.h"
#include "planner/plan/plan_files/plan_file.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/options/quantity_option.h"
#include "sim/cli/options/resolver_option.h"
#include "sim/cli/plan_output/explanation.h"
#include "sim/cli/plan_output/plan_report.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/cli/tree_output/contingent_report.h"
#include "sim/cli/tree_output/plan_tree_report.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/scenario/models_folder.h"

namespace assay::cli {
namespace plan_verb {

using Json = nlohmann::ordered_json;

struct Options {
  std::filesystem::path input;
  std::filesystem::path output;
  domain::ModelPath models;
  bool json = false;
  bool trace = false;
  bool check = false;
  bool tree = false;
  int instances = 1;
  std::int64_t budget = constraint_posting::PlannerOptions().partial_plans;
  double errors_times = 1;
  std::string propagation = "sound";
  std::vector<std::string> resolvers = {};           // empty: the scenario's
  std::optional<std::string> explain;                // a step's place, from 1, or its id
  std::vector<const CLI::Option*> of_planning = {};  // options that have no use with a plan file
};

constraint_posting::PlannerOptions PlannerOptionsFrom(const Options& options) {
  constraint_posting::PlannerOptions planner;
  planner.partial_plans = options.budget;
  if (options.trace) {
    planner.trace = [](const std::string& line) { Remark(assay::Show(line) + "\n"); };
  }
  return planner;
}

constraint_posting::UncertaintyOptions UncertaintyOptionsFrom(const Options& options) {
  return {.propagation = options.propagation == "paper" ? uncertainty::Propagation::kPaper
                                                        : uncertainty::Propagation::kSound};
}

void RefuseOptionsOfPlanning(const Options& options) {
  for (const CLI::Option* option : options.of_planning) {
    if (option->count() == 0) continue;
    throw UsageError(
        fmt::format("{} is for scenarios, and {} is a plan file (see assay plan --help)",
                    option->get_name(), options.input.string()));
  }
  if (options.tree) throw UsageError("--tree is for scenarios (see assay plan --help)");
}

// Returns plan instances of the first phase, in the order in which they are found.
std::vector<plan::Plan> ListInstances(const domain::Problem& problem, const Options& options) {
  std::vector<plan::Plan> instances;
  if (options.instances == 1) return instances;
  constraint_posting::PlannerOptions planner;
  planner.partial_plans = options.budget;
  planner.accept = [&](const plan::Plan& instance) {
    instances.push_back(instance);
    return std::ssize(instances) >= options.instances;
  };
  constraint_posting::MakePlan(problem, planner);
  return instances;
}

Json InstanceToJson(const plan::Plan& instance, const domain::Problem& problem) {
  const Json plan = plan::ToJson({Outcome::kFound, instance, {}, {}}, problem, "");
  return {{"actions", plan["actions"]}, {"ordering", plan["ordering"]}};
}

plan::StepId StepToExplain(const plan::Plan& plan, const std::string& named) {
  const std::vector<plan::StepId> order = plan.ExecutionOrder();
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (named == plan.step(order[i]).name || named == std::to_string(i + 1)) return order[i];
  }
  throw UsageError(fmt::format(
      "plan: --explain: there is no step {}; allowed: 1 to {}, or an id such as {} (see assay plan "
      "--help)",
      Quote(named), order.size(), order.empty() ? "action_1" : plan.step(order.front()).name));
}

std::string CountersText(const plan::PlanResult& result, double seconds) {
  std::vector<std::string> counters;
  for (const auto& [name, count] : result.counters) {
    counters.push_back(fmt::format("{} {}", name, count));
  }
  return fmt::format("counters: {}; planned in {:.2f} s\n", fmt::join(counters, ", "), seconds);
}

std::string ForPeople(const PlannedProblem& planned, const std::vector<plan::Plan>& instances,
                      const Options& options) {
  const bool found = planned.result.outcome == Outcome::kFound;
  if (options.explain && found) {
    const plan::Plan& plan = planned.result.plan;
    const plan::StepId step = StepToExplain(plan, *options.explain);
    return Explanation(planned.problem, plan, step, planned.file()) +
           UnprovedWaysText(planned.problem, plan, step);
  }
  std::string text = Text(planned.problem, planned.result);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    text += fmt::format("\nplan instance {} of the first phase\n{}", i + 1,
                        PlanTable(planned.problem, instances[i]));
  }
  return text;
}

// An explanation of a flawed plan may be what helps to find its flaws.
std::string ForPeopleOfFlawed(const PlannedProblem& planned, const Options& options) {
  if (!options.explain || planned.result.outcome != Outcome::kFound) {
    return TextOfFlawed(planned.problem, planned.result);
  }
  return "The plan has flaws, so nothing in it is proved. The file says of this step:\n" +
         Explanation(planned.problem, planned.result.plan,
                     StepToExplain(planned.result.plan, *options.explain), planned.file());
}

void RequireTreeOptions(const Options& options) {
  if (!options.explain && !options.check && options.instances == 1 && options.output.empty())
    return;
  throw UsageError(
      "the plan of this scenario is a tree; --explain, --check, --instances and --output are for "
      "plans of one world only, and --json prints the tree for programs (see assay plan --help)");
}

ExitCode ExecuteTree(const std::vector<domain::Problem>& worlds, const Options& options) {
  RequireTreeOptions(options);
  const Stopwatch stopwatch;
  const assembly::ContingentAssembly assembly = [&] {
    const Progress progress("planning " + worlds.front().name);
    return assembly::MakeContingentPlan(worlds, PlannerOptionsFrom(options),
                                        UncertaintyOptionsFrom(options));
  }();
  Json json = ToJson(worlds, assembly);
  json["seconds"] = stopwatch.Seconds();
  Print(options.json ? plan::JsonText(json) : Text(worlds, assembly));
  return ExitCodeOf(assembly.outcome);
}

// Plans a tree for a goal of knowledge.
ExitCode ExecuteKnowledge(const Document& document, const Options& options) {
  RequireTreeOptions(options);
  const Stopwatch stopwatch;
  const domain::ModelPath models = scenario::FindModels(options.input, options.models);
  execution::KnowledgeScenario scenario = execution::Read(document, models);
  ContingentAnswer answer = [&] {
    const Progress progress("planning " + options.input.string());
    return PlanFor(std::move(scenario.interpretation.task), contingent::Wanted::kFirst,
                   kKnowledgeStates);
  }();
  answer.unserved = std::move(scenario.interpretation.unserved);
  answer.seconds = stopwatch.Seconds();
  Print(options.json ? JsonText(answer) : Text(answer, false, kKnowledgeStates));
  return ExitCodeOf(answer.plan.outcome);
}

ExitCode ExecutePlan(const PlannedProblem& planned, double seconds, const Options& options) {
  const domain::Problem& problem = planned.problem;
  const plan::PlanResult& result = planned.result;
  const std::vector<plan::Plan> instances = ListInstances(problem, options);

  Json json;
  if (options.json || !options.output.empty()) {
    json = plan::ToJson(result, problem, planned.scenario);
  }
  const std::string plan_file = options.output.empty() ? "" : plan::LaidOut(json);
  // What a plan file claims is shown only if it holds.
  std::optional<plan::CheckReport> check;
  if (!planned.plan_file.empty() || (options.check && result.outcome == Outcome::kFound)) {
    check = CheckPlan(planned);
  }
  const bool holds = !check || check->flaws.empty();
  std::string text =
      holds ? ForPeople(planned, instances, options) : ForPeopleOfFlawed(planned, options);
  for (const plan::Plan& instance : instances) {
    json["instances"].push_back(InstanceToJson(instance, problem));
  }
  if (check && (options.check || !holds)) {
    json["check"] = ToJson(result.plan, *check);
    text += Text(result.plan, *check);
  }
  json["seconds"] = seconds;
  if (!options.explain) text += CountersText(result, seconds);
  PrintAndWrite(options.json ? plan::LaidOut(json) : text, [&] {
    if (!options.output.empty()) WriteFile(options.output, plan_file);
  });
  return holds ? ExitCodeOf(result.outcome) : ExitCode::kFailed;
}

ExitCode Execute(const Options& options) {
  const Document document = Document::Load(options.input);
  RequireWritable(options.output);
  const Stopwatch stopwatch;
  // A plan file is shown as it is.
  if (IsPlanFile(document)) {
    RefuseOptionsOfPlanning(options);
    const PlannedProblem planned = ReadPlan(document, options.models);
    return ExecutePlan(planned, stopwatch.Seconds(), options);
  }
  if (document.root().Find("knowledge")) return ExecuteKnowledge(document, options);
  std::vector<domain::Problem> worlds =
      ReadWorldsToPlan(document, options.models, {.resolvers = ResolversFrom(options.resolvers)});
  for (domain::Problem& world : worlds)
    world = budget::WithErrorsTimes(world, options.errors_times);
  if (worlds.size() > 1 || options.tree) return ExecuteTree(worlds, options);
  const PlannedProblem planned =
      MakePlan(document, {std::move(worlds.front()), scenario::ReadSimulation(document)},
               PlannerOptionsFrom(options), UncertaintyOptionsFrom(options));
  return ExecutePlan(planned, stopwatch.Seconds(), options);
}

void DeclarePlanning(CLI::App& command, Options& options, CLI::Option* output) {
  options.of_planning = {
      command.add_flag("--trace", options.trace, "print the planner's decisions to standard error"),
      command
          .add_option(
              "--instances", options.instances,
              "also list up to this many plan instances of the first phase, without certificates")
          ->check(CLI::Range(1, 1'000'000)),
      command
          .add_option("--propagation", options.propagation,
                      "how errors pass from step to step: sound (correct for all errors) or paper "
                      "(as published)")
          ->check(CLI::IsMember({"sound", "paper"}))
          ->capture_default_str(),
      command
          .add_option("--errors-times", options.errors_times,
                      "plan with so many times all errors, tolerances and promises of sensors (see "
                      "assay budget)")
          ->check(Within(domain::kAtLeastZero, domain::kRatio))
          ->excludes(output),
      AddResolvers(command, options.resolvers),
      command
          .add_option("--budget", options.budget,
                      "greatest number of partial plans that the search looks at; it also limits "
                      "the search for ways of the arm")
          ->check(CLI::Range(1, std::numeric_limits<int>::max()))
          ->capture_default_str()};
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("input", options->input, "scenario file, or a plan file to show")->required();
  CLI::Option* const output =
      command.add_option("-o,--output", options->output, "write the plan to this file");
  CLI::Option* const json = command.add_flag(
      "--json", options->json, "print the plan as JSON, with the planning time in seconds");
  command
      .add_option(
          "--explain", options->explain,
          "instead of printing the plan, tell why the step with this place or id is safe or not")
      ->type_name("STEP")
      ->excludes(json);
  command.add_flag("--check", options->check, "check the plan and its certificates");
  command.add_flag("--tree", options->tree,
                   "print the plan as a tree: verifications branch, recoveries repeat");
  DeclarePlanning(command, *options, output);
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace plan_verb

const Verb kPlan = {
    .name = "plan",
    .summary = "makes a plan with certificates, or a plan tree, for a scenario",
    .page = "planner/planning.md",
    .example =
        "assay plan scenarios/spar-fig13.yaml -o plan.json\n"
        "  assay plan plan.json --explain action_3",
    .declare = plan_verb::Declare,
};

}  // namespace assay::cli
