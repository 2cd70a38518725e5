#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/budget_output/budget_report.h"
#include "sim/cli/budget_output/budgeted_plan.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/report/charts/front_chart.h"

namespace assay::cli {
namespace budget_verb {

struct Options {
  std::filesystem::path input;
  domain::ModelPath models;
  std::vector<std::string> front;  // names of groups of errors
  std::filesystem::path drawing;
  bool json = false;
};

ExitCode Execute(const Options& options) {
  const Stopwatch stopwatch;
  if (!options.drawing.empty()) {
    if (options.front.empty()) throw UsageError("-o draws a front; name its errors with --front");
    RequireWritable(options.drawing);
  }
  const PlannedProblem planned = ReadOrMakePlan(Document::Load(options.input), options.models);
  RequireSound(planned);
  if (planned.result.outcome != Outcome::kFound) {
    PrintError(fmt::format("{}: there is no plan whose errors could be multiplied",
                           options.input.string()));
    return ExitCodeOf(planned.result.outcome);
  }
  const BudgetedPlan budgeted = [&] {
    const Progress progress("multiplying the errors of " + planned.problem.name);
    return BudgetOf(planned, options.front);
  }();
  if (!options.drawing.empty()) {
    WriteFile(options.drawing,
              report::SvgFile(report::FrontChart(FrontPictureOf(budgeted.budget))));
  }
  const plan::Plan& plan = planned.result.plan;
  nlohmann::ordered_json json = ToJson(budgeted, plan);
  json["seconds"] = stopwatch.Seconds();
  Print(options.json ? plan::JsonText(json) : Text(budgeted, plan));
  return ExitCode::kDone;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("input", options->input, "scenario file, or plan file")->required();
  command
      .add_option("--front", options->front,
                  "two or three errors, for example hand.xy,peg.theta: their Pareto front")
      ->delimiter(',');
  command.add_option("-o,--output", options->drawing, "draw the front to this SVG file");
  command.add_flag("--json", options->json, "print the result for programs");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace budget_verb

const Verb kBudget = {
    .name = "budget",
    .summary = "tells how great the errors may be so that everything is proved",
    .page = "sim/budget.md",
    .example = "assay budget scenarios/uncertain-known.yaml",
    .declare = budget_verb::Declare,
};

}  // namespace assay::cli
