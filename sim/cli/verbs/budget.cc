#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/base/counted.h"
#include "planner/budget/budget.h"
#include "planner/plan/plan_files/json_layout.h"
#include "planner/probability/distributed_errors.h"
#include "planner/probability/failure_probability.h"
#include "sim/cli/budget_output/budget_report.h"
#include "sim/cli/budget_output/probability_report.h"
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

using Json = nlohmann::ordered_json;

struct Options {
  std::filesystem::path input;
  domain::ModelPath models;
  std::vector<std::string> front;  // names of groups of errors
  std::filesystem::path drawing;
  bool json = false;
};

// What the scenario says of smaller errors, and of the probabilities of errors.
struct BudgetKeys {
  std::vector<budget::PriceList> prices;
  std::optional<probability::DistributedErrors> errors;
};

BudgetKeys KeysOf(const PlannedProblem& planned) {
  const Document scenario = Document::Load(planned.scenario);
  const domain::Units units = domain::ReadUnits(scenario.root());
  BudgetKeys keys;
  if (const auto prices = scenario.root().Find("prices")) {
    keys.prices = budget::ReadPrices(*prices, units, budget::ErrorQuantitiesOf(planned.problem));
  }
  if (const auto distributions = scenario.root().Find("distributions")) {
    keys.errors = {probability::ReadDistributions(*distributions, units, planned.problem), {}};
  }
  if (const auto correlations = scenario.root().Find("correlations")) {
    if (!keys.errors) keys.errors.emplace();
    keys.errors->correlations =
        probability::ReadCorrelations(*correlations, keys.errors->distributions, planned.problem);
  }
  return keys;
}

// Returns the groups that the option --front names.
std::vector<budget::QuantityGroup> GroupsNamed(const std::vector<std::string>& names,
                                               const domain::Problem& problem) {
  if (names.size() == 1 || names.size() > 3) {
    throw UsageError(fmt::format("--front has {}; allowed: two or three, such as hand.xy,peg.theta",
                                 Counted(names.size(), "error")));
  }
  const auto quantities = budget::ErrorQuantitiesOf(problem);
  std::vector<budget::QuantityGroup> groups;
  std::set<std::size_t> named;
  for (const std::string& name : names) {
    const auto group = budget::FindGroup(name, quantities);
    if (!group) {
      throw UsageError(fmt::format("--front: '{}' is no error of this scenario; allowed: {}", name,
                                   budget::NamesOf(quantities)));
    }
    for (const std::size_t of : group->quantities) {
      if (named.insert(of).second) continue;
      throw UsageError(fmt::format("--front names '{}' twice", quantities[of].name));
    }
    groups.push_back(*group);
  }
  return groups;
}

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
  const auto groups = GroupsNamed(options.front, planned.problem);
  const BudgetKeys keys = KeysOf(planned);
  const plan::Plan& plan = planned.result.plan;
  std::optional<probability::FailureProbabilities> failures;
  const budget::Budget budget = [&] {
    const Progress progress("multiplying the errors of " + planned.problem.name);
    if (keys.errors) failures = FailureProbabilitiesOf(planned.problem, plan, *keys.errors);
    return budget::BudgetOf(planned.problem, plan, keys.prices, groups);
  }();
  if (!options.drawing.empty())
    WriteFile(options.drawing, report::SvgFile(report::FrontChart(FrontPictureOf(budget))));
  Json json = ToJson(budget);
  std::string text = Text(budget);
  if (failures) {
    json["failures"] = ToJson(*failures, plan);
    text += "\n" + Text(*failures, plan);
  }
  json["seconds"] = stopwatch.Seconds();
  Print(options.json ? plan::JsonText(json) : text);
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
