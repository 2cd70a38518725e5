#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "planner/plan/plan_file.h"
#include "sim/cli/console.h"
#include "sim/cli/output_file.h"
#include "sim/cli/plan_report.h"
#include "sim/cli/plan_text.h"
#include "sim/cli/planned_problem.h"
#include "sim/cli/stopwatch.h"
#include "sim/cli/verb.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string scenario;
  std::filesystem::path output;
  std::filesystem::path models;
  bool json = false;
  bool trace = false;
  bool check = false;
  int instances = 1;
  std::int64_t budget = posting::PlannerOptions().partial_plans;
};

// The planner's answer with the plan instances in the order in which they were found.
struct Answer {
  plan::PlanResult result;  // with the first instance
  std::vector<plan::Plan> instances;
};

Answer MakeInstances(const domain::Problem& problem, const Options& options) {
  Answer answer;
  posting::PlannerOptions planner;
  planner.partial_plans = options.budget;
  planner.accept = [&](const plan::Plan& instance) {
    answer.instances.push_back(instance);
    return std::ssize(answer.instances) >= options.instances;
  };
  if (options.trace) {
    planner.trace = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };
  }
  answer.result = PlanWithProgress(problem, planner, {});
  // Fewer than were asked for are an answer, too.
  if (!answer.instances.empty()) {
    answer.result.outcome = Outcome::kFound;
    answer.result.plan = answer.instances.front();
    answer.result.conflict.clear();
  }
  return answer;
}

Json InstanceToJson(const plan::Plan& instance, const domain::Problem& problem) {
  const Json plan = plan::ToJson({Outcome::kFound, instance, {}, {}}, problem, "");
  return {{"actions", plan["actions"]}, {"ordering", plan["ordering"]}};
}

std::string ForPeople(const Answer& answer, const domain::Problem& problem, const Options& options,
                      double seconds) {
  std::string text;
  if (options.instances > 1 && answer.result.outcome == Outcome::kFound) {
    for (std::size_t i = 0; i < answer.instances.size(); ++i) {
      text += fmt::format("plan instance {}\n{}", i + 1, PlanTable(problem, answer.instances[i]));
    }
  } else {
    text = Text(problem, answer.result);
  }
  std::vector<std::string> counters;
  for (const auto& [name, count] : answer.result.counters) {
    counters.push_back(fmt::format("{} {}", name, count));
  }
  return text + fmt::format("{}; {:.2f} s\n", fmt::join(counters, ", "), seconds);
}

ExitCode Execute(const Options& options) {
  RequireWritable(options.output);
  const domain::Problem problem = LoadScenario(options.scenario, options.models).problem;
  const Stopwatch stopwatch;
  const Answer answer = MakeInstances(problem, options);
  const double seconds = stopwatch.Seconds();
  const bool found = answer.result.outcome == Outcome::kFound;

  const Json plan_file = plan::ToJson(answer.result, problem, options.scenario);
  Json json = plan_file;
  std::string text = options.json ? "" : ForPeople(answer, problem, options, seconds);
  if (options.instances > 1) {
    json["instances"] = Json::array();
    for (const plan::Plan& instance : answer.instances) {
      json["instances"].push_back(InstanceToJson(instance, problem));
    }
  }
  bool holds = true;
  if (options.check && found) {
    const plan::CheckReport report = CheckPlan(problem, answer.result.plan);
    holds = report.flaws.empty();
    json["check"] = ToJson(answer.result.plan, report);
    text += Text(answer.result.plan, report);
  }
  json["seconds"] = seconds;
  Print(options.json ? json.dump(2) + "\n" : text);
  if (!options.output.empty()) WriteFile(options.output, plan_file.dump(2) + "\n");
  return holds ? ExitCodeOf(answer.result.outcome) : ExitCode::kFailed;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("scenario", options->scenario, "scenario file")->required();
  command.add_option("-o,--output", options->output, "write the plan to this file");
  command.add_flag("--json", options->json, "print the plan as JSON, with the seconds it took");
  command.add_flag("--trace", options->trace, "print the planner's decisions to standard error");
  command.add_option("--instances", options->instances, "how many plan instances to list")
      ->check(CLI::Range(1, 1'000'000));
  command.add_flag("--check", options->check, "check the plan with the independent checker");
  command.add_option("--budget", options->budget, "how many partial plans to look at")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()))
      ->capture_default_str();
  command.add_option("--models", options->models, "folder with parts/ and workcells/")
      ->check(CLI::ExistingDirectory);
  return [options] { return Execute(*options); };
}

}  // namespace

const Verb kPlan = {
    .name = "plan",
    .summary = "makes a plan for a scenario",
    .example = "assay plan scenarios/spar-fig13.yaml -o plan.json",
    .declare = Declare,
};

}  // namespace assay::cli
