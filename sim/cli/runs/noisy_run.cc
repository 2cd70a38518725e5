#include "sim/cli/runs/noisy_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/base/stop.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/check/noise_floor/noiseless.h"
#include "sim/check/trial_verdicts/ledger.h"
#include "sim/check/trial_verdicts/trial.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/plan_output/certificate_text.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/trial_output/ledger_report.h"
#include "sim/cli/trial_output/trial_report.h"
#include "sim/cli/trial_output/verdict_tally.h"
#include "sim/execution/trial/scheduler.h"
#include "sim/noise/possible_start.h"
#include "sim/noise/sampling.h"
#include "sim/sweep/database/wilson.h"

namespace assay::cli {
namespace {

using check::Trial;
using execution::TrialOutcome;
using Json = nlohmann::ordered_json;

// The results of one trial that are kept.
struct NoisyRow {
  int number = 0;
  TrialOutcome outcome = TrialOutcome::kSucceeded;
  std::string reason = {};
  std::string noise = {};
  int errors_signalled = 0;
  int recovered = 0;
  bool operator_called = false;
  bool violated = false;
  std::vector<check::Claim> claims = {};
  std::vector<check::LedgerEntry> ledger = {};  // for a single trial

  bool Failed() const { return outcome != TrialOutcome::kSucceeded || violated; }
};

class NoisyTrials {
 public:
  explicit NoisyTrials(const NoisyRun& run)
      : run_(run),
        plan_(run.planned.result.plan),
        is_camera_(run.command.sensing == "camera"),
        box_(noise::ErrorBox(run.planned.problem, plan_)),
        experiment_{run.planned.problem, plan_, run.planned.simulation.scene} {}

  ExitCode Execute() {
    const Interruption interruption;
    if (TakeNoiseFloor(experiment_) && HoldsWithoutNoise()) {
      execution::Scheduler(run_.jobs, Interruption::Requested)
          .InOrder(
              static_cast<std::size_t>(Wanted()),
              [this](std::size_t i) {
                return RowOf(RunOne(run_.command.trial.value_or(static_cast<int>(i) + 1)));
              },
              [this](std::size_t, NoisyRow row) { Keep(std::move(row)); });
    }
    progress_.reset();
    const Json result = Result();
    Json printed = result;
    printed["seconds"] = stopwatch_.Seconds();
    PrintAndWrite(run_.json ? plan::JsonText(printed) : Report(), [&] {
      if (!run_.folder.empty()) WriteFile(run_.folder / "result.json", plan::JsonText(result));
    });
    const bool holds = noiseless_.Holds() && Failed() == 0;
    return Interruption::CodeOr(holds ? ExitCode::kDone : ExitCode::kFailed);
  }

 private:
  // Returns false, too, if an interruption came before the answer.
  bool HoldsWithoutNoise() {
    if (run_.command.errors || run_.command.trial) return true;
    try {
      noiseless_ = check::ExecuteWithoutNoise(experiment_);
    } catch (const Stopped&) {
      return false;
    }
    return noiseless_.Holds();
  }

  int Wanted() const { return run_.command.trial ? 1 : run_.trials; }
  bool IsSingle() const { return Wanted() == 1; }

  noise::Noise NoiseOf(int number) const {
    return run_.command.errors
               ? NoiseFrom(*run_.command.errors, run_.planned)
               : noise::Sample(run_.planned.problem, box_, run_.mode, run_.seed, number);
  }

  Trial RunOne(int number) const {
    execution::ExecutorOptions options;
    if (run_.folder.empty()) options.sample_rate = 0;
    Trial trial = RunTrial(experiment_, NoiseOf(number), options,
                           is_camera_ ? check::Sensing::kCamera : check::Sensing::kDrawn);
    trial.number = number;
    return trial;
  }

  // The ledger of a single trial is in the result, not in a file.
  void WriteFiles(const Trial& trial) const {
    std::ostringstream text;
    execution::WriteTrace(trial.trace, text);
    WriteFile(run_.folder / fmt::format("trace-{}.jsonl", trial.number), text.str());
    if (IsSingle()) return;
    const Json ledger = ToJson(check::LedgerOf(experiment_, trial.noise, trial.trace));
    WriteFile(run_.folder / fmt::format("ledger-{}.json", trial.number), plan::JsonText(ledger));
  }

  NoisyRow RowOf(Trial trial) const {
    if (!run_.folder.empty()) WriteFiles(trial);
    NoisyRow row = {.number = trial.number,
                    .outcome = trial.verdict.outcome,
                    .reason = trial.verdict.reason,
                    .noise = noise::Text(trial.noise),
                    .errors_signalled = trial.errors_signalled,
                    .recovered = trial.recovered,
                    .operator_called = trial.operator_called,
                    .violated = std::ranges::any_of(trial.claims, &check::Claim::IsViolated),
                    .claims = std::move(trial.claims)};
    if (IsSingle()) row.ledger = check::LedgerOf(experiment_, trial.noise, trial.trace);
    return row;
  }

  void Keep(NoisyRow row) {
    rows_.push_back(std::move(row));
    progress_->Tell({std::ssize(rows_), Wanted(), "trials"});
  }

  std::map<std::string, int> Outcomes() const {
    std::map<std::string, int> outcomes;
    for (const NoisyRow& row : rows_) ++outcomes[std::string(execution::Name(row.outcome))];
    return outcomes;
  }
  int Count(const auto& holds) const {
    return static_cast<int>(std::ranges::count_if(rows_, holds));
  }
  int Succeeded() const {
    return Count([](const NoisyRow& row) { return row.outcome == TrialOutcome::kSucceeded; });
  }
  int Failed() const {
    return Count([](const NoisyRow& row) { return row.Failed(); });
  }

  std::string ReplayCommand(int number) const {
    if (run_.command.errors) return run_.command.Text();
    return run_.command.Again(run_.seed, number).Text();
  }

  // Returns the ledger of a single trial.
  std::vector<check::LedgerEntry> Ledger() const {
    return rows_.empty() ? std::vector<check::LedgerEntry>() : rows_.front().ledger;
  }

  VerdictTally Tally() const {
    VerdictTally tally(plan_);
    for (const NoisyRow& row : rows_) tally.Add(row.claims);
    return tally;
  }

  Json Result() const {
    const VerdictTally tally = Tally();
    Json failed = Outcomes();
    failed.erase("succeeded");
    Json result = {{"trials", rows_.size()},
                   {"succeeded", Succeeded()},
                   {"failed", failed.is_null() ? Json::object() : failed},
                   {"verdicts", tally.ToJson()},
                   {"claims", tally.ClaimsToJson()},
                   {"without_noise", ToJson(plan_, noiseless_)},
                   {"worst", tally.WorstToJson()},
                   {"replay", Json::array()},
                   {"scenario", run_.planned.scenario},
                   {"seed", run_.seed},
                   {"grasp", scene::Name(run_.planned.simulation.scene.grasp)},
                   {"noise", noise::Name(run_.mode)},
                   {"sensing", is_camera_ ? "camera" : "drawn"},
                   {"gate", ToJson(plan_, experiment_.gate)},
                   {"rows", Json::array()}};
    if (Interruption::Requested()) result["interrupted"] = true;
    for (const NoisyRow& row : rows_) {
      if (row.Failed()) result["replay"].push_back(ReplayCommand(row.number));
      result["rows"].push_back({{"trial", row.number},
                                {"outcome", execution::Name(row.outcome)},
                                {"reason", row.reason},
                                {"violated", row.violated},
                                {"errors_signalled", row.errors_signalled},
                                {"recovered", row.recovered},
                                {"operator_called", row.operator_called},
                                {"noise", row.noise}});
    }
    if (IsSingle()) result["ledger"] = ToJson(Ledger());
    return result;
  }

  std::string Report() const {
    std::string text = "noise floors of the claims\n";
    text += Text(plan_, experiment_.gate) + "\n";
    if (!noiseless_.Holds()) return text + Text(plan_, noiseless_, experiment_.gate);
    text += Tally().Text(run_.planned.problem) + "\n";
    if (!Ledger().empty()) text += Text(Ledger()) + "\n";
    constexpr int kMostListed = 3;
    int listed = 0;
    for (const NoisyRow& row : rows_) {
      if (!row.Failed() || ++listed > kMostListed) continue;
      text += fmt::format("trial {}: {}{}{}\nto repeat it: {}\n", row.number,
                          execution::Name(row.outcome), row.reason.empty() ? "" : ": ", row.reason,
                          ReplayCommand(row.number));
    }
    if (listed > kMostListed) text += fmt::format("and {} more\n", listed - kMostListed);
    if (listed > 0) text += "\n";
    for (const auto& [name, count] : Outcomes()) {
      if (name != "succeeded") text += fmt::format("{}: {}\n", name, count);
    }
    const int trials = static_cast<int>(rows_.size());
    const Interval rate = sweep::WilsonInterval(Succeeded(), trials);
    text +=
        fmt::format("{} of {} trials succeeded (95 % interval of the rate: {:.1f} to {:.1f} %)\n",
                    Succeeded(), trials, 100 * rate.low, 100 * rate.high);
    const int signalled = Count([](const NoisyRow& row) { return row.errors_signalled > 0; });
    if (signalled > 0) {
      text += fmt::format(
          "errors were signalled in {} trials, recovered from in {}, the operator called in {}\n",
          signalled, Count([](const NoisyRow& row) { return row.recovered > 0; }),
          Count([](const NoisyRow& row) { return row.operator_called; }));
    }
    text += Interruption::Text(trials, Wanted());
    text += NotCoveredText(run_.planned.problem, plan_);
    if (!run_.folder.empty()) text += fmt::format("files in {}\n", run_.folder.string());
    return text;
  }

  const NoisyRun& run_;
  const plan::Plan& plan_;
  const bool is_camera_;  // looks are taken by the camera instead of drawn
  const Stopwatch stopwatch_;
  std::unique_ptr<Progress> progress_ = std::make_unique<Progress>("executing under noise");
  const std::vector<noise::Channel> box_;
  check::Experiment experiment_;
  check::Noiseless noiseless_;  // execution before the trials; not used for a single trial
  std::vector<NoisyRow> rows_;  // in the order of their numbers
};

}  // namespace

noise::Noise NoiseFrom(const std::string& errors, const PlannedProblem& planned) {
  try {
    noise::Noise noise =
        noise::ParseNoise(errors, noise::ErrorBox(planned.problem, planned.result.plan));
    noise::PossibleStart(planned.problem).Require(noise);
    return noise;
  } catch (const InputError& error) {
    throw UsageError(fmt::format("run: --errors: {}", error.what()));
  }
}

ExitCode RunNoisy(const NoisyRun& run) { return NoisyTrials(run).Execute(); }

}  // namespace assay::cli
