#include "sim/cli/runs/scattered_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "planner/assembly/certified_plan.h"
#include "planner/domain/problem/scatter.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/plan_output/table.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/execution/trial/scheduler.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kSucceeded = "succeeded";

struct ScatteredRow {
  int number = 0;
  std::string outcome = {};
  std::string reason = {};
  int actions = 0;
};

class Scattering {
 public:
  Scattering(const ScatteredRun& run, const scenario::Scenario& scenario)
      : run_(run), scenario_(scenario), progress_("planning and executing") {}

  ExitCode Execute() {
    const Interruption interruption;
    execution::Scheduler(run_.jobs, Interruption::Requested)
        .InOrder(
            static_cast<std::size_t>(Wanted()),
            [this](std::size_t i) {
              return RunOne(run_.command.trial.value_or(static_cast<int>(i) + 1));
            },
            [this](std::size_t, ScatteredRow row) { Keep(std::move(row)); });
    const Json result = Result();
    Json printed = result;
    printed["seconds"] = stopwatch_.Seconds();
    PrintAndWrite(run_.json ? plan::JsonText(printed) : Report(), [&] {
      if (!run_.folder.empty()) WriteFile(run_.folder / "result.json", plan::JsonText(result));
    });
    const bool all_succeeded = Succeeded() == static_cast<int>(rows_.size());
    return Interruption::CodeOr(all_succeeded ? ExitCode::kDone : ExitCode::kFailed);
  }

 private:
  int Wanted() const { return run_.command.trial ? 1 : run_.trials; }

  ScatteredRow RunOne(int number) const {
    RandomStream random(run_.seed, fmt::format("scatter/{}", number));
    const std::optional<domain::Problem> problem = domain::Scatter(scenario_.problem, random);
    if (!problem) return {number, "no-room", "no places for all parts were found"};
    const plan::PlanResult result = assembly::MakeCertifiedPlan(*problem, {}, {});
    if (result.outcome != Outcome::kFound) return WithoutPlan(number, result);
    const int actions = static_cast<int>(result.plan.steps.size());
    const plan::CheckReport check = CheckPlan(*problem, result.plan);
    if (!check.flaws.empty()) return {number, "flawed-plan", check.flaws.front().what, actions};

    const scene::Scene scene(*problem, scenario_.simulation.scene);
    check::Trial trial = check::RunTrial(*problem, result.plan, scene, {});
    trial.number = number;
    const bool succeeded = trial.verdict.outcome == execution::TrialOutcome::kSucceeded;
    if (!run_.folder.empty() && (run_.command.trial || !succeeded)) WriteTrace(trial);
    return {number, std::string(execution::Name(trial.verdict.outcome)), trial.verdict.reason,
            actions};
  }

  static ScatteredRow WithoutPlan(int number, const plan::PlanResult& result) {
    if (!result.limits.empty()) {
      return {number, "budget", fmt::format("{}", fmt::join(result.limits, "; "))};
    }
    return result.outcome == Outcome::kNone
               ? ScatteredRow{number, "no-plan",
                              fmt::format("{}", fmt::join(TextsOf(result.conflict), "; "))}
               : ScatteredRow{number, "budget",
                              "the planner's budget was spent before there was an answer"};
  }

  void WriteTrace(const check::Trial& trial) const {
    std::ostringstream text;
    execution::WriteTrace(trial.trace, text);
    WriteFile(run_.folder / fmt::format("trace-{}.jsonl", trial.number), text.str());
  }

  void Keep(ScatteredRow row) {
    rows_.push_back(std::move(row));
    progress_.Tell({std::ssize(rows_), Wanted(), "trials"});
  }

  std::map<std::string, int> Outcomes() const {
    std::map<std::string, int> outcomes;
    for (const ScatteredRow& row : rows_) ++outcomes[row.outcome];
    return outcomes;
  }
  int Succeeded() const {
    const auto outcomes = Outcomes();
    const auto found = outcomes.find(std::string(kSucceeded));
    return found == outcomes.end() ? 0 : found->second;
  }

  bool Welds() const { return scenario_.simulation.scene.grasp == scene::GraspMode::kWeld; }

  std::string ReplayCommand(int number) const {
    return run_.command.Again(run_.seed, number).Text();
  }

  Json Result() const {
    Json failed = Outcomes();
    failed.erase(std::string(kSucceeded));
    Json result = {{"trials", rows_.size()},
                   {"succeeded", Succeeded()},
                   {"failed", failed.is_null() ? Json::object() : failed},
                   {"verdicts", {{"contained", 0}, {"violated", 0}, {"inconclusive", 0}}},
                   {"worst", Json::array()},
                   {"replay", Json::array()},
                   {"scenario", run_.command.input.string()},
                   {"seed", run_.seed},
                   {"grasp", Welds() ? "weld" : "friction"},
                   {"rows", Json::array()}};
    if (Interruption::Requested()) result["interrupted"] = true;
    for (const ScatteredRow& row : rows_) {
      if (row.outcome != kSucceeded) result["replay"].push_back(ReplayCommand(row.number));
      result["rows"].push_back({{"trial", row.number},
                                {"outcome", row.outcome},
                                {"reason", row.reason},
                                {"actions", row.actions}});
    }
    return result;
  }

  std::string Report() const {
    Table counts({{"outcome"}, {"trials", Align::kRight}});
    for (const auto& [outcome, count] : Outcomes()) counts.Add({outcome, std::to_string(count)});
    std::string text = counts.Text();
    for (const ScatteredRow& row : rows_) {
      if (row.outcome == kSucceeded) continue;
      text += fmt::format("\ntrial {}: {}: {}\nto repeat it: {}\n", row.number, row.outcome,
                          row.reason, ReplayCommand(row.number));
    }
    text += fmt::format("\n{} of {} trials succeeded\n", Succeeded(), rows_.size());
    text += Interruption::Text(std::ssize(rows_), Wanted());
    if (!run_.folder.empty()) text += fmt::format("files in {}\n", run_.folder.string());
    return text;
  }

  const ScatteredRun& run_;
  const scenario::Scenario& scenario_;
  const Stopwatch stopwatch_;
  std::vector<ScatteredRow> rows_;  // in the order of their numbers
  Progress progress_;
};

}  // namespace

ExitCode RunScattered(const ScatteredRun& run, const scenario::Scenario& scenario) {
  return Scattering(run, scenario).Execute();
}

}  // namespace assay::cli
