#include <fmt/format.h>

#include "planner/base/input_files/input_error.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/usage_error.h"
#include "sim/cli/shown_executions/trial_execution.h"
#include "sim/cli/tasks/stored_trial.h"

namespace assay::cli {
namespace {

using sweep::FalsificationRecord;
using sweep::TrialRecord;

// The errors of a trial, and its name for people.
struct StoredNoise {
  noise::Noise noise;
  std::string name;
};

// Without a counterexample, the worst claim of the falsification is shown.
StoredNoise NoiseOfFalsification(const TrialRecord& trial,
                                 const std::optional<FalsificationRecord>& falsification,
                                 const sweep::PlannedCell& cell, const ShowRequest& request) {
  const auto parsed = [&](const std::string& text) {
    return noise::ParseNoise(text, cell.preparation->box);
  };
  const std::size_t all = falsification ? falsification->counterexamples.size() : 0;
  if (all == 0 && !request.counterexample) {
    return {parsed(trial.noise), fmt::format("worst claim of trial {}", trial.trial)};
  }
  const auto number = static_cast<std::size_t>(request.counterexample.value_or(1));
  if (number > all) {
    throw UsageError(fmt::format("{}: trial {} has no counterexample {}; it has {}", request.verb,
                                 trial.trial, number, all));
  }
  return {parsed(falsification->counterexamples[number - 1].noise),
          fmt::format("counterexample {} of trial {}", number, trial.trial)};
}

StoredNoise NoiseOf(const TrialRecord& trial, const sweep::Store& store,
                    const sweep::PlannedCell& cell, const ShowRequest& request) {
  if (cell.cell.noise == sweep::NoiseKind::kFalsification) {
    return NoiseOfFalsification(trial, store.FindFalsification(trial.cell), cell, request);
  }
  if (request.counterexample) {
    throw UsageError(fmt::format(
        "{}: trial {} is no falsification; allowed: --counterexample for cells with the noise "
        "attack",
        request.verb, trial.trial));
  }
  return {sweep::NoiseOf(cell, trial.number), fmt::format("trial {}", trial.trial)};
}

}  // namespace

ShownExecution StoredTrialExecution(const ShowRequest& request) {
  if (!request.number) {
    throw UsageError(request.verb + ": a database needs the number of a trial");
  }
  const sweep::Store store = sweep::Store::Open(request.input);
  const TrialRecord stored = StoredTrial(store, *request.number, request.verb);
  const sweep::PlannedCell cell = RestoredCell(store, stored, request.models);
  const auto [noise, name] = NoiseOf(stored, store, cell, request);
  const sweep::Preparation& preparation = *cell.preparation;
  check::Trial trial = [&] {
    const Progress progress(name);
    return sweep::Execute(cell, noise, nullptr, execution::ExecutorOptions().sample_rate);
  }();
  const std::string file = request.input.string();
  return TrialExecution({.problem = preparation.scenario.problem,
                         .plan = preparation.plan,
                         .scene = preparation.scenario.simulation.scene,
                         .gate = preparation.gate},
                        std::move(trial), fmt::format("{} in {}", name, file), file);
}

}  // namespace assay::cli
