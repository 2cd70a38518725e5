#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "planner/base/input_files/input_error.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/check/trial_verdicts/ledger.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/picture_output/step_pictures.h"
#include "sim/cli/plan_output/table.h"
#include "sim/cli/tasks/noise_floor_cache.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/stored_trial.h"
#include "sim/cli/trial_output/ledger_report.h"
#include "sim/cli/trial_output/verdict_tally.h"
#include "sim/execution/walk/executor.h"
#include "sim/sweep/database/difference.h"
#include "sim/sweep/database/recording.h"
#include "sim/sweep/database/store.h"
#include "sim/sweep/runner/work.h"

namespace assay::cli {
namespace replay_verb {

using Json = nlohmann::ordered_json;
using sweep::TrialRecord;
namespace fs = std::filesystem;

struct Options {
  fs::path database;
  int trial = 1;
  domain::ModelPath models;
  fs::path folder;
  PictureOptions pictures;
  bool renders = false;
  bool json = false;
};

bool IsFalsification(const sweep::PlannedCell& cell) {
  return cell.cell.noise == sweep::NoiseKind::kFalsification;
}

void SetNumbers(const TrialRecord& from, TrialRecord& to) {
  to.trial = from.trial;
  to.cell = from.cell;
  to.number = from.number;
}

// A repeated trial, and how it differs from the stored one. A falsification has no ledger.
struct Again {
  TrialRecord record;
  std::vector<check::CertificateVerdict> verdicts;
  std::vector<std::string> differences = {};
  std::vector<check::LedgerEntry> ledger = {};
};

Again RunAgain(const sweep::PlannedCell& cell, const TrialRecord& stored, StepPictures* pictures) {
  const Progress progress(fmt::format("trial {}", stored.trial));
  const noise::Noise noise = sweep::NoiseOf(cell, stored.number);
  const sweep::Preparation& preparation = *cell.preparation;
  const check::Trial trial = sweep::Execute(cell, noise, pictures);
  const check::Experiment experiment{preparation.scenario.problem, preparation.plan,
                                     preparation.scenario.simulation.scene};
  sweep::TimedTrial timed = sweep::Recorded(preparation.plan, trial);
  Again again{.record = std::move(timed.record),
              .verdicts = std::move(timed.verdicts),
              .ledger = check::LedgerOf(experiment, noise, trial.trace)};
  SetNumbers(stored, again.record);
  again.differences = sweep::Differences(stored, again.record);
  return again;
}

// Repeats a trial and takes pictures of it.
Again RunFilmed(const sweep::PlannedCell& cell, const TrialRecord& stored, const Options& options) {
  const scenario::Scenario& scenario = cell.preparation->scenario;
  const noise::Noise noise = sweep::NoiseOf(cell, stored.number);
  const scene::Scene scene(scenario.problem,
                           execution::TrueScene(scenario.simulation.scene, noise));
  StepPictures pictures({scenario.problem, cell.preparation->plan, scene},
                        scenario.simulation.cameras, options.pictures);
  Again again = RunAgain(cell, stored, &pictures);
  pictures.Write(options.folder);
  return again;
}

Again FalsificationAgain(const sweep::Store& store, const sweep::Work& work,
                         const sweep::PlannedCell& cell, const TrialRecord& stored) {
  if (const std::optional<sweep::FalsificationRecord> falsification =
          store.FindFalsification(stored.cell)) {
    Progress progress(fmt::format("trial {}", stored.trial));
    sweep::FalsificationControl control{
        .jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))};
    control.progress = [&](std::int64_t made) {
      progress.Tell({made, falsification->attempts, "attempts"});
    };
    sweep::TimedTrial timed = work.falsification(cell, control);
    SetNumbers(stored, timed.record);
    std::vector<std::string> differences = sweep::Differences(stored, timed.record);
    std::ranges::move(sweep::Differences(*falsification, *timed.falsification),
                      std::back_inserter(differences));
    return {.record = std::move(timed.record),
            .verdicts = std::move(timed.verdicts),
            .differences = std::move(differences)};
  }
  throw InputError({.file = store.file().string()},
                   fmt::format("the attack of cell {} is missing", stored.cell),
                   "a database as it was written");
}

Again Repeat(const sweep::Store& store, const sweep::Work& work, const sweep::PlannedCell& cell,
             const TrialRecord& stored, const Options& options) {
  if (!IsFalsification(cell)) {
    return options.renders ? RunFilmed(cell, stored, options) : RunAgain(cell, stored, nullptr);
  }
  if (options.renders) {
    throw UsageError(fmt::format(
        "replay: trial {} is a falsification, which has no pictures; allowed: --renders for other "
        "trials. assay sweep show {} prints the commands for its counterexamples",
        stored.trial, store.file().string()));
  }
  return FalsificationAgain(store, work, cell, stored);
}

std::string VerdictTable(const plan::Plan& plan,
                         const std::vector<check::CertificateVerdict>& verdicts) {
  Table table(
      {{"step", Align::kRight}, {"id"}, {"verdict"}, {"worst claim"}, {"margin", Align::kRight}});
  for (const check::CertificateVerdict& verdict : verdicts) {
    const plan::PlannedStep& step = plan.step(verdict.step);
    const check::Claim& worst = verdict.worst;
    table.Add(
        {std::to_string(step.executed), step.name, std::string(check::Name(verdict.verdict)),
         Text(worst),
         QuantityText(worst.margin, ShownUnitOf(worst.dimension.value_or(Dimension::kRatio)))});
  }
  return table.Text();
}

std::string OutcomeText(const TrialRecord& record) {
  return record.reason.empty() ? record.outcome
                               : fmt::format("{}: {}", record.outcome, record.reason);
}

std::string ForPeople(const plan::Plan& plan, const TrialRecord& stored, const Again& again) {
  std::string text =
      fmt::format("trial {}: number {} of cell {}\nnoise, in m and rad: {}\n", stored.trial,
                  stored.number, stored.cell, stored.noise.empty() ? "none" : stored.noise);
  text += fmt::format("stored:   {}\nrepeated: {}\n\n{}\n", OutcomeText(stored),
                      OutcomeText(again.record), VerdictTable(plan, again.verdicts));
  if (!again.ledger.empty()) text += Text(again.ledger) + "\n";
  if (again.differences.empty())
    return text + "the result is the same as the stored result, to the last bit\n";
  text += "the result differs from the stored result (stored; repeated):\n";
  for (const std::string& difference : again.differences) text += fmt::format("  {}\n", difference);
  return text;
}

Json ToJson(const TrialRecord& record) {
  Json verdicts = Json::array();
  for (const sweep::VerdictRecord& verdict : record.verdicts) {
    verdicts.push_back({{"step", verdict.step},
                        {"action", verdict.action},
                        {"verdict", verdict.verdict},
                        {"claim", verdict.claim},
                        {"observed", verdict.observed},
                        {"margin", verdict.margin},
                        {"gate", verdict.gate}});
  }
  return {{"outcome", record.outcome}, {"reason", record.reason}, {"verdicts", verdicts}};
}

ExitCode Execute(const Options& options) {
  if (!options.folder.empty()) MakeFolder(options.folder);
  const sweep::Store store = sweep::Store::Open(options.database);
  const TrialRecord stored = StoredTrial(store, options.trial, "replay");
  const sweep::Sweep sweep = SweepOf(store);
  const sweep::PlannedCell cell = RestoredCell(store, stored, options.models);
  const Again again =
      Repeat(store, sweep::RealWork(sweep, options.models, KeptNoiseFloor), cell, stored, options);
  const bool equal = again.differences.empty();
  const Json json = {{"trial", stored.trial},
                     {"cell", stored.cell},
                     {"number", stored.number},
                     {"noise", stored.noise},
                     {"equal", equal},
                     {"differences", again.differences},
                     {"stored", ToJson(stored)},
                     {"again", ToJson(again.record)},
                     {"ledger", cli::ToJson(again.ledger)}};
  Print(options.json ? plan::JsonText(json) : ForPeople(cell.preparation->plan, stored, again));
  return equal ? ExitCode::kDone : ExitCode::kFailed;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("database", options->database, "database of a sweep")->required();
  command.add_option("trial", options->trial, "number of the trial")
      ->required()
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  CLI::Option* const folder =
      command.add_option("-o,--output", options->folder, "folder for pictures");
  command
      .add_flag("--renders", options->renders,
                "take pictures of the start, each step's end, and grasps and matings on the way")
      ->needs(folder);
  AddPictureOptions(command, options->pictures, "--renders");
  command.add_flag("--json", options->json, "print the result as JSON");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace replay_verb

const Verb kReplay = {
    .name = "replay",
    .summary = "runs one trial of a sweep again, and tells whether the result is the same",
    .page = "sim/sweeps.md",
    .example = "assay replay fig15.sqlite 17 --renders -o out/trial-17",
    .declare = replay_verb::Declare,
};

}  // namespace assay::cli
