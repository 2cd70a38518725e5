#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>

#include "planner/base/input_files/input_error.h"
#include "planner/base/input_files/input_file.h"
#include "planner/base/input_files/quotation.h"
#include "sim/check/certificate_claims/certificate_check.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/plan_output/plan_text.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/execution/interpretation/knowledge_scenario.h"
#include "sim/view/page.h"

namespace assay::cli {
namespace view_verb {

namespace fs = std::filesystem;

struct Options {
  fs::path input;
  fs::path page;
  fs::path plan;  // of a trace; empty: plan.json beside it
  domain::ModelPath models;
};

constexpr std::size_t kMostTraceBytes = std::size_t{1} << 30;

bool IsTrace(std::string_view text) { return text.starts_with(R"({"format":"assay-trace/)"); }

void Write(const view::Subject& subject, const fs::path& file) {
  const std::string page = view::Page(subject);
  WriteFile(file, page);
  Print(fmt::format("{}: {:.1f} s in {} kB\n", file.string(), subject.trace.end().moment.time,
                    (page.size() + 500) / 1000));
}

// A trace does not hold its plan.
fs::path PlanBeside(const Options& options) {
  if (!options.plan.empty()) return options.plan;
  const fs::path plan = options.input.parent_path() / "plan.json";
  std::error_code ignored;
  if (fs::exists(plan, ignored)) return plan;
  throw UsageError(fmt::format("view: there is no {} beside the trace; allowed: --plan FILE",
                               Quote(plan.string())));
}

// Returns why the trace is not one of this plan; empty if it is one.
std::string Mismatch(const execution::Trace& trace, const PlannedProblem& planned) {
  const domain::Problem& problem = planned.problem;
  const plan::Plan& plan = planned.result.plan;
  if (trace.problem != problem.name ||
      !std::ranges::equal(trace.parts, problem.parts, {}, {}, &domain::Part::name)) {
    return fmt::format("it is a trace of {}, and the plan {} is for {}", Quote(trace.problem),
                       planned.plan_file, problem.name);
  }
  const auto has_step = [&](plan::StepId step) {
    return step.index() >= 0 && step.index() < static_cast<int>(plan.steps.size());
  };
  for (const execution::Milestone* milestone : trace.All<execution::Milestone>()) {
    if (!has_step(milestone->step)) return "the plan does not have all steps of the trace";
  }
  for (const execution::StepEnd* end : trace.All<execution::StepEnd>()) {
    if (!has_step(end->step) ||
        plan::ShortText(problem, plan.step(end->step).action) != end->action) {
      return fmt::format("{} of the trace is not a step of the plan", Quote(end->action));
    }
  }
  const auto samples = trace.All<execution::Sample>();
  if (samples.empty()) return "the trace has no samples";
  const bool same_robots = std::ranges::all_of(samples, [&](const execution::Sample* sample) {
    return sample->moment.arms.size() == problem.workcell->robots().size();
  });
  return same_robots ? "" : "it is a trace of other robots";
}

ExitCode ViewTrace(const Options& options, std::string_view text) {
  const execution::Trace trace = execution::ReadTrace(text, options.input.string());
  const PlannedProblem planned = ReadPlan(Document::Load(PlanBeside(options)), options.models);
  if (const std::string mismatch = Mismatch(trace, planned); !mismatch.empty()) {
    throw InputError({.file = options.input.string()}, mismatch,
                     "a trace of the plan as assay run -o writes it");
  }
  const plan::Plan& plan = planned.result.plan;
  const scene::Scene scene(planned.problem, planned.simulation.scene);
  const check::NoiseFloor gate =
      KeptNoiseFloor(planned.problem, plan, planned.simulation.scene, "assay view");
  Write({.problem = planned.problem,
         .plan = plan,
         .scene = scene,
         .trace = trace,
         .claims = check::CheckCertificates(planned.problem, plan, trace, gate),
         .source = "trace " + options.input.string(),
         .plan_file = planned.plan_file},
        options.page);
  return ExitCode::kDone;
}

// Executes the plan once without noise.
ExitCode ViewPlan(const Options& options) {
  const Document document = Document::Load(options.input);
  const bool is_plan = IsPlanFile(document);
  if (!is_plan && execution::NeedsATree(document)) {
    throw UsageError(fmt::format("view: the plan for {} is a tree; allowed: plans without branches",
                                 Quote(options.input.string())));
  }
  const PlannedProblem planned = ReadOrMakePlan(document, options.models);
  if (planned.result.outcome != Outcome::kFound) {
    Print(Text(planned.problem, planned.result));
    return ExitCodeOf(planned.result.outcome);
  }
  const plan::Plan& plan = planned.result.plan;
  const scene::Scene scene(planned.problem, planned.simulation.scene);
  const check::Trial trial = [&] {
    const Progress progress("executing the plan for " + planned.problem.name);
    execution::ExecutorOptions executor;
    executor.on_timestep = Interruption::BreakOffAfter;
    return check::RunTrial(planned.problem, plan, scene, executor);
  }();
  Write({.problem = planned.problem,
         .plan = plan,
         .scene = scene,
         .trace = trial.trace,
         .source = fmt::format("{} {}, executed without noise", is_plan ? "plan" : "scenario",
                               options.input.string()),
         .plan_file = planned.file()},
        options.page);
  const bool done = trial.trace.end().outcome == execution::TrialOutcome::kSucceeded;
  return done ? ExitCode::kDone : ExitCode::kFailed;
}

ExitCode Execute(const Options& options) {
  RequireWritable(options.page);
  const std::string text =
      ReadInput(options.input, "a scenario file, plan file or trace", kMostTraceBytes);
  return IsTrace(text) ? ViewTrace(options, text) : ViewPlan(options);
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("input", options->input,
                  "scenario file or plan file, which is executed once without noise; or a trace")
      ->required();
  command.add_option("-o,--output", options->page, "HTML file to write")->required();
  command.add_option("--plan", options->plan,
                     "plan file of a trace; plan.json beside the trace if left out");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace view_verb

const Verb kView = {
    .name = "view",
    .summary = "writes a page that shows an execution in three dimensions, with its certificates",
    .page = "sim/viewing.md",
    .example =
        "assay view scenarios/spar-fig13.yaml -o out/fig13.html\n"
        "  assay view out/fig13/trace.jsonl -o out/fig13.html",
    .declare = view_verb::Declare,
};

}  // namespace assay::cli
