#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/input_files/input_error.h"
#include "planner/domain/workcell/sensor_promise.h"
#include "planner/plan/plan_files/json_layout.h"
#include "sim/cli/command_line/console.h"
#include "sim/cli/command_line/interruption.h"
#include "sim/cli/command_line/progress.h"
#include "sim/cli/command_line/stopwatch.h"
#include "sim/cli/command_line/verb.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/options/quantity_option.h"
#include "sim/cli/tasks/output_file.h"
#include "sim/cli/tasks/planned_problem.h"
#include "sim/cli/trial_output/calibration_report.h"
#include "sim/scenario/models_folder.h"
#include "sim/sense/overhead_camera.h"

namespace assay::cli {
namespace calibrate_verb {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Options {
  std::vector<fs::path> scenarios;
  domain::ModelPath models;
  int trials = 100;          // in each scenario
  std::optional<int> trial;  // the only trial to run
  std::optional<std::uint64_t> seed;
  double margin = 1.5;
  bool write = false;
  bool json = false;
};

CalibratedScenario Read(const fs::path& file, const Options& options) {
  CalibratedScenario subject{.file = file,
                             .scenario = scenario::Load(file, options.models),
                             .promise = {},
                             .workcell_file = {}};
  const domain::Workcell& workcell = *subject.problem().workcell;
  const auto* promise = workcell.uncertainty_operations().FindSensor(kCalibratedSensor);
  if (promise == nullptr) {
    throw InputError(
        {file.string()},
        fmt::format("its workcell {} has no sensor {}", workcell.name(), kCalibratedSensor),
        "a workcell that has it");
  }
  subject.promise = *promise;
  subject.seed = options.seed.value_or(subject.scenario.simulation.seed);
  subject.workcell_file = scenario::FindModels(file, options.models).WorkcellFile(workcell.name());
  return subject;
}

// The camera above the parts of one scenario.
class Calibration {
 public:
  explicit Calibration(const CalibratedScenario& subject)
      : subject_(subject),
        scene_(subject.problem(), subject.scenario.simulation.scene),
        camera_(scene_, subject.problem()) {}

  CalibrationTrial Measure(int number) {
    const auto placement =
        sense::DrawCalibrationPlacement(subject_.problem(), subject_.seed, number);
    if (!placement) {
      throw InputError({subject_.file.string()}, "its parts have no room on the table",
                       "fewer parts or a larger table");
    }
    return {&subject_, number, *placement, sense::MeasuredError(scene_, *placement, camera_)};
  }

 private:
  const CalibratedScenario& subject_;
  const scene::Scene scene_;
  sense::OverheadCamera camera_;
};

// Returns how many placements are measured, in all scenarios.
std::int64_t Wanted(const Options& options) {
  return std::ssize(options.scenarios) * (options.trial ? 1 : options.trials);
}

// An interruption ends the measurement, and the trials that were made until then are returned.
std::vector<CalibrationTrial> MeasureAll(const std::vector<CalibratedScenario>& subjects,
                                         const Options& options) {
  Progress progress("measuring parts");
  progress.Tell({0, Wanted(options), "placements"});
  const int first = options.trial.value_or(1);
  const int last = options.trial.value_or(options.trials);
  std::vector<CalibrationTrial> trials;
  for (const CalibratedScenario& subject : subjects) {
    Calibration calibration(subject);
    for (int number = first; number <= last && !Interruption::Requested(); ++number) {
      trials.push_back(calibration.Measure(number));
      progress.Tell({std::ssize(trials), Wanted(options), "placements"});
    }
  }
  return trials;
}

// Returns each workcell file once, in the order of the scenarios.
std::vector<fs::path> WorkcellFiles(const std::vector<CalibratedScenario>& subjects) {
  std::vector<fs::path> files;
  for (const CalibratedScenario& subject : subjects) {
    if (std::ranges::count(files, subject.workcell_file) == 0) {
      files.push_back(subject.workcell_file);
    }
  }
  return files;
}

// Returns the text of the workcell's file with the measured promise.
std::string Promising(const fs::path& file, const CalibrationReport& result) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return domain::WithPromise(text, file.string(), kCalibratedSensor, result.Promise(),
                             result.Note());
}

void Write(const std::vector<fs::path>& files, const CalibrationReport& result) {
  std::vector<std::string> texts;
  for (const fs::path& file : files) texts.push_back(Promising(file, result));
  for (std::size_t i = 0; i < files.size(); ++i) AmendFile(files[i], texts[i]);
}

std::string PromiseForPeople(const CalibrationReport& result,
                             const std::vector<fs::path>& written) {
  constexpr domain::Units kMetresAndDegrees = {.length = domain::kMetres,
                                               .angle = domain::kDegrees};
  std::string text = fmt::format("{} times the greatest errors, in metres and degrees: {}\n",
                                 result.margin(), PromiseText(result.Promise(), kMetresAndDegrees));
  for (const fs::path& file : written) text += fmt::format("written into {}\n", file.string());
  return text;
}

ExitCode Execute(const Options& options) {
  std::vector<CalibratedScenario> subjects;
  for (const fs::path& file : options.scenarios) subjects.push_back(Read(file, options));
  std::vector<fs::path> files;
  if (options.write) files = WorkcellFiles(subjects);
  std::ranges::for_each(files, RequireAmendable);
  const Stopwatch stopwatch;
  const Interruption interruption;
  std::vector<CalibrationTrial> trials = MeasureAll(subjects, options);
  const std::string interrupted =
      Interruption::Text(std::ssize(trials), Wanted(options), "placements were measured");
  // A promise must not be based on fewer placements than were asked for.
  if (!interrupted.empty()) files.clear();
  const CalibrationReport result(subjects, std::move(trials), options.margin, options.models);
  const bool has_promise = result.found() > 0;
  if (has_promise) Write(files, result);
  Json json = result.ToJson();
  json["seconds"] = stopwatch.Seconds();
  if (!interrupted.empty()) json["interrupted"] = true;
  Print(options.json  ? plan::JsonText(json)
        : has_promise ? result.ForPeople() + PromiseForPeople(result, files) + interrupted
                      : result.ForPeople() + interrupted);
  // A promise that was just written is kept by definition.
  const bool kept = has_promise && (options.write || result.KeepsPromise());
  return Interruption::CodeOr(kept ? ExitCode::kDone : ExitCode::kFailed);
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("scenarios", options->scenarios,
                  "scenario files; their parts are measured on the tables of their workcells")
      ->required();
  command.add_option("--trials", options->trials, "number of random placements in each scenario")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_option("--trial", options->trial, "measure only the placement with this number")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_option("--seed", options->seed,
                     "seed of the placements; the scenario's seed if left out");
  command
      .add_option("--margin", options->margin,
                  "the promise is the greatest measured error, times this factor")
      ->check(Within({1, 100}, kRatioUnit));
  command.add_flag(
      "--write", options->write,
      "write the promise into the files of the workcells; nothing else in them changes");
  command.add_flag("--json", options->json, "print the result as JSON, in metres and radians");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace calibrate_verb

const Verb kCalibrate = {
    .name = "calibrate",
    .summary = "measures whether the camera keeps its promise at random placements",
    .page = "sim/running.md",
    .example =
        "assay calibrate scenarios/spar-fig15.yaml --trials 1000 --seed 1\n"
        "  assay calibrate scenarios/spar-fig15.yaml scenarios/keyed.yaml --trials 1000 --write",
    .declare = calibrate_verb::Declare,
};

}  // namespace assay::cli
