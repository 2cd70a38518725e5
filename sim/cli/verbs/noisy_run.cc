#include "sim/cli/verbs/noisy_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "planner/base/document/input_error.h"
#include "planner/plan/file/json_layout.h"
#include "sim/check/claims/noiseless.h"
#include "sim/check/trial/ledger.h"
#include "sim/check/trial/noisy_trial.h"
#include "sim/cli/plans/certificate_text.h"
#include "sim/cli/program/console.h"
#include "sim/cli/program/interruption.h"
#include "sim/cli/program/progress.h"
#include "sim/cli/program/stopwatch.h"
#include "sim/cli/program/usage_error.h"
#include "sim/cli/trials/ledger_report.h"
#include "sim/cli/trials/trial_report.h"
#include "sim/cli/trials/verdict_tally.h"
#include "sim/cli/work/noise_floor_cache.h"
#include "sim/cli/work/output_file.h"
#include "sim/cli/work/trial.h"
#include "sim/exec/execution/executor.h"
#include "sim/sense/overhead_camera.h"
#include "sim/sweep/run/shell.h"
#include "sim/sweep/store/wilson.h"

namespace assay::cli {
namespace {

using check::NoisyTrial;
using check::TrialOutcome;
using Json = nlohmann::ordered_json;

// The results of one trial that are kept.
struct NoisyRow {
  TrialOutcome outcome = TrialOutcome::kSucceeded;
  std::string reason = {};
  std::string noise = {};
  int errors_signalled = 0;
  int recovered = 0;
  bool operator_called = false;
  bool violated = false;

  bool Failed() const { return outcome != TrialOutcome::kSucceeded || violated; }
};

class NoisyTrials {
 public:
  explicit NoisyTrials(const NoisyRun& run)
      : run_(run),
        plan_(run.planned.result.plan),
        box_(noise::ErrorBox(run.planned.problem, plan_)),
        experiment_{run.planned.problem, plan_, run.planned.simulation.scene,
                    KeptNoiseFloor(run.planned, run.command)} {}

  ExitCode Execute() {
    const Interruption interruption;
    if (!run_.errors && !run_.only) noiseless_ = check::ExecuteWithoutNoise(experiment_);
    if (noiseless_.Holds()) {
      ForEachTrial(Wanted(), run_.jobs, [this](int nth) {
        const int number = run_.only.value_or(nth);
        Keep(number, RunOne(number));
      });
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
  int Wanted() const { return run_.only ? 1 : run_.trials; }
  bool IsSingle() const { return Wanted() == 1; }

  noise::Noise NoiseOf(int number) const {
    return run_.errors ? NoiseFrom(*run_.errors, run_.planned)
                       : noise::Sample(box_, run_.mode, run_.seed, number);
  }

  NoisyTrial RunOne(int number) const {
    exec::ExecutorOptions options;
    options.on_timestep = [](const mujoco::Data&) { Interruption::BreakOffIfRequested(); };
    const bool traces = !run_.folder.empty();
    if (!traces) options.sample_rate = 0;
    const noise::Noise noise = NoiseOf(number);
    if (!run_.camera) return RunNoisyTrial(experiment_, noise, options);
    // Each trial has a camera of its own, because a renderer belongs to its thread and its scene.
    const scene::Scene scene(experiment_.problem, exec::TrueScene(experiment_.scene, noise));
    sense::OverheadCamera camera(scene, experiment_.problem);
    options.sensor = &camera;
    return RunNoisyTrial(experiment_, noise, options);
  }

  // The ledger of a single trial is in the result, not in a file.
  void WriteFiles(int number, const NoisyTrial& trial) const {
    std::ostringstream text;
    exec::WriteTrace(trial.trace, text);
    WriteFile(run_.folder / fmt::format("trace-{}.jsonl", number), text.str());
    if (IsSingle()) return;
    const Json ledger = ToJson(check::LedgerOf(experiment_, trial.noise, trial.trace));
    WriteFile(run_.folder / fmt::format("ledger-{}.json", number), plan::JsonText(ledger));
  }

  void Keep(int number, NoisyTrial trial) {
    if (!run_.folder.empty()) WriteFiles(number, trial);
    if (IsSingle()) ledger_ = check::LedgerOf(experiment_, trial.noise, trial.trace);
    const NoisyRow row = {.outcome = trial.verdict.outcome,
                          .reason = trial.verdict.reason,
                          .noise = noise::Text(trial.noise),
                          .errors_signalled = trial.errors_signalled,
                          .recovered = trial.recovered,
                          .operator_called = trial.operator_called,
                          .violated = std::ranges::any_of(trial.claims, &check::Claim::IsViolated)};
    const std::lock_guard lock(mutex_);
    claims_.emplace(number, std::move(trial.claims));
    rows_.emplace(number, row);
    progress_->Tell(fmt::format("{} of {} trials", rows_.size(), Wanted()));
  }

  std::map<std::string, int> Outcomes() const {
    std::map<std::string, int> outcomes;
    for (const auto& [number, row] : rows_) ++outcomes[std::string(check::Name(row.outcome))];
    return outcomes;
  }
  int Count(const auto& holds) const {
    return static_cast<int>(
        std::ranges::count_if(rows_, [&](const auto& entry) { return holds(entry.second); }));
  }
  int Succeeded() const {
    return Count([](const NoisyRow& row) { return row.outcome == TrialOutcome::kSucceeded; });
  }
  int Failed() const {
    return Count([](const NoisyRow& row) { return row.Failed(); });
  }

  std::string ReplayCommand(int number) const {
    std::string command = run_.command;
    if (run_.errors) return fmt::format("{} --errors {}", command, sweep::Quoted(*run_.errors));
    return fmt::format("{} --noise {}{} --seed {} --trial {}", command, noise::Name(run_.mode),
                       run_.camera ? " --sensing camera" : "", run_.seed, number);
  }

  VerdictTally Tally() const {
    VerdictTally tally(plan_);
    for (const auto& [number, claims] : claims_) tally.Add(claims);
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
                   {"sensing", run_.camera ? "camera" : "drawn"},
                   {"gate", ToJson(plan_, experiment_.gate)},
                   {"rows", Json::array()}};
    if (Interruption::Requested()) result["interrupted"] = true;
    for (const auto& [number, row] : rows_) {
      if (row.Failed()) result["replay"].push_back(ReplayCommand(number));
      result["rows"].push_back({{"trial", number},
                                {"outcome", check::Name(row.outcome)},
                                {"reason", row.reason},
                                {"violated", row.violated},
                                {"errors_signalled", row.errors_signalled},
                                {"recovered", row.recovered},
                                {"operator_called", row.operator_called},
                                {"noise", row.noise}});
    }
    if (IsSingle()) result["ledger"] = ToJson(ledger_);
    return result;
  }

  std::string Report() const {
    std::string text = "noise floors of the claims\n";
    text += Text(plan_, experiment_.gate) + "\n";
    if (!noiseless_.Holds()) return text + Text(plan_, noiseless_, experiment_.gate);
    text += Tally().Text(run_.planned.problem) + "\n";
    if (!ledger_.empty()) text += Text(ledger_) + "\n";
    constexpr int kMostTold = 3;
    int told = 0;
    for (const auto& [number, row] : rows_) {
      if (!row.Failed() || ++told > kMostTold) continue;
      text += fmt::format("trial {}: {}{}{}\nagain: {}\n", number, check::Name(row.outcome),
                          row.reason.empty() ? "" : ": ", row.reason, ReplayCommand(number));
    }
    if (told > kMostTold) text += fmt::format("and {} more\n", told - kMostTold);
    if (told > 0) text += "\n";
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
    text += NotCoveredText(plan_);
    if (!run_.folder.empty()) text += fmt::format("files in {}\n", run_.folder.string());
    return text;
  }

  const NoisyRun& run_;
  const plan::Plan& plan_;
  const Stopwatch stopwatch_;
  std::unique_ptr<Progress> progress_ = std::make_unique<Progress>("executing under noise");
  const std::vector<noise::Channel> box_;
  const check::Experiment experiment_;
  check::Noiseless noiseless_;  // execution before the trials; not used for a single trial
  std::mutex mutex_;
  std::map<int, NoisyRow> rows_;  // by number
  std::map<int, std::vector<check::Claim>> claims_;
  std::vector<check::LedgerEntry> ledger_;  // for a single trial
};

}  // namespace

noise::Noise NoiseFrom(const std::string& errors, const PlannedProblem& planned) {
  try {
    return noise::ParseNoise(errors, noise::ErrorBox(planned.problem, planned.result.plan));
  } catch (const InputError& error) {
    throw UsageError(fmt::format("run: --errors: {}", error.what()));
  }
}

ExitCode RunNoisy(const NoisyRun& run) { return NoisyTrials(run).Execute(); }

}  // namespace assay::cli
