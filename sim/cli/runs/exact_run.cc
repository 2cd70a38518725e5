#include "sim/cli/runs/exact_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

#include "planner/plan/plan_files/json_layout.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/plan_output/certificate_text.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/trial_output/trial_report.h"
#include "sim/execution/trial/scheduler.h"

namespace assay::cli {
namespace {

using Json = nlohmann::ordered_json;

// The results of one trial that are kept.
struct Summary {
  execution::TrialOutcome outcome;
  std::string reason;

  bool Succeeded() const { return outcome == execution::TrialOutcome::kSucceeded; }
};

class ExactTrials {
 public:
  explicit ExactTrials(const ExactRun& run)
      : run_(run), planned_(run.planned), scene_(planned_.problem, planned_.simulation.scene) {}

  ExitCode Execute() {
    std::optional<StepPictures> pictures;
    if (run_.renders) {
      pictures.emplace(PicturedPlan{planned_.problem, planned_.result.plan, scene_},
                       planned_.simulation.cameras, run_.pictures);
    }
    const Interruption interruption;
    execution::Scheduler(run_.jobs, Interruption::Requested)
        .InOrder(
            static_cast<std::size_t>(run_.trials),
            [&](std::size_t i) {
              return RunOne(static_cast<int>(i) + 1, pictures ? &*pictures : nullptr);
            },
            [this](std::size_t, check::Trial trial) { Keep(std::move(trial)); });
    progress_.reset();
    const Json result = Result();
    Json printed = result;
    printed["seconds"] = stopwatch_.Seconds();
    PrintAndWrite(run_.json ? plan::JsonText(printed) : Report(), [&] {
      if (run_.folder.empty()) return;
      WriteFile(run_.folder / "result.json", plan::JsonText(result));
      if (pictures) pictures->Write(run_.folder);
    });
    return Interruption::CodeOr(Succeeded() == Trials() ? ExitCode::kDone : ExitCode::kFailed);
  }

 private:
  // The pictures show the first trial.
  check::Trial RunOne(int number, StepPictures* pictures) const {
    execution::ExecutorOptions executor;
    executor.observer = number == 1 ? pictures : nullptr;
    check::Trial trial = check::RunTrial(planned_.problem, planned_.result.plan, scene_, executor);
    trial.number = number;
    if (!run_.folder.empty()) WriteTrace(trial);
    return trial;
  }

  void Keep(check::Trial trial) {
    summaries_[trial.number] = {trial.verdict.outcome, trial.verdict.reason};
    progress_->Tell({Trials(), run_.trials, "trials"});
    if (trial.number == 1) first_ = std::move(trial);
  }

  void WriteTrace(const check::Trial& trial) const {
    std::ostringstream text;
    execution::WriteTrace(trial.trace, text);
    const std::string name =
        trial.number == 1 ? "trace.jsonl" : fmt::format("trace-{}.jsonl", trial.number);
    WriteFile(run_.folder / name, text.str());
  }

  int Trials() const { return static_cast<int>(summaries_.size()); }
  int Succeeded() const {
    return static_cast<int>(std::ranges::count_if(
        summaries_, [](const auto& entry) { return entry.second.Succeeded(); }));
  }

  // Returns the numbers of failures by outcome.
  std::map<std::string, int> Failures() const {
    std::map<std::string, int> failures;
    for (const auto& [number, summary] : summaries_) {
      if (!summary.Succeeded()) ++failures[std::string(execution::Name(summary.outcome))];
    }
    return failures;
  }

  // Returns the command that repeats the failed trials.
  std::string ReplayCommand() const { return run_.command.Again(run_.seed, std::nullopt).Text(); }

  Json Result() const {
    const int succeeded = Succeeded();
    Json result = {{"trials", Trials()},
                   {"succeeded", succeeded},
                   {"failed", Failures()},
                   {"verdicts", {{"contained", 0}, {"violated", 0}, {"inconclusive", 0}}},
                   {"worst", Json::array()},
                   {"replay", Json::array()}};
    if (Interruption::Requested()) result["interrupted"] = true;
    if (succeeded < Trials()) result["replay"].push_back(ReplayCommand());
    result["scenario"] = planned_.scenario;
    result["seed"] = run_.seed;
    result["grasp"] = scene::Name(scene_.options().grasp);
    if (first_) result["first"] = ToJson(planned_.problem, planned_.result.plan, *first_);
    return result;
  }

  std::string Report() const {
    std::string text =
        first_ ? ForPeople(planned_.problem, planned_.result.plan, *first_) + "\n" : "";
    const int succeeded = Succeeded();
    text += fmt::format("{} of {} trials succeeded\n", succeeded, Trials());
    for (const auto& [name, count] : Failures()) text += fmt::format("{}: {}\n", name, count);
    if (succeeded < Trials()) {
      const auto failed = std::ranges::find_if(
          summaries_, [](const auto& entry) { return !entry.second.Succeeded(); });
      text += fmt::format("trial {}: {}\nto repeat it: {}\n", failed->first, failed->second.reason,
                          ReplayCommand());
    }
    text += Interruption::Text(Trials(), run_.trials);
    text += NotCoveredText(planned_.problem, planned_.result.plan);
    if (!run_.folder.empty()) text += fmt::format("files in {}\n", run_.folder.string());
    return text;
  }

  const ExactRun& run_;
  const PlannedProblem& planned_;
  const scene::Scene scene_;
  const Stopwatch stopwatch_;
  std::map<int, Summary> summaries_;  // by number
  std::optional<check::Trial> first_;
  std::unique_ptr<Progress> progress_ = std::make_unique<Progress>("executing the plan");
};

}  // namespace

ExitCode RunExact(const ExactRun& run) { return ExactTrials(run).Execute(); }

}  // namespace assay::cli
