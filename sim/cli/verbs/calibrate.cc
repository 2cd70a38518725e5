#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/base/document/input_error.h"
#include "planner/domain/workcell/sensor_promise.h"
#include "planner/plan/file/json_layout.h"
#include "sim/cli/options/models_folder.h"
#include "sim/cli/options/quantity.h"
#include "sim/cli/options/quantity_option.h"
#include "sim/cli/plans/table.h"
#include "sim/cli/program/console.h"
#include "sim/cli/program/progress.h"
#include "sim/cli/program/stopwatch.h"
#include "sim/cli/program/verb.h"
#include "sim/cli/work/output_file.h"
#include "sim/cli/work/planned_problem.h"
#include "sim/scenario/models_folder.h"
#include "sim/sense/calibration.h"
#include "sim/sense/overhead_camera.h"
#include "sim/sweep/run/shell.h"

namespace assay::cli {
namespace calibrate_verb {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using domain::SensorPromise;
using geometry::Pose;
using sense::CalibrationPlacement;
using sense::Displacement;

constexpr char kSensor[] = "overhead-camera";
constexpr std::array kCoordinates = {"x", "y", "z", "theta"};  // coordinates of a displacement
constexpr std::array kUnits = {kLengthUnit, kLengthUnit, kLengthUnit, kAngleUnit};

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

// A scenario whose parts are put at random places on its table.
struct Subject {
  fs::path file;
  scenario::Scenario scenario;
  domain::SensorModel promise;
  std::uint64_t seed = 0;
  fs::path workcell_file;

  const domain::Problem& problem() const { return scenario.problem; }
};

struct Trial {
  const Subject* subject = nullptr;
  int number = 0;  // from 1
  CalibrationPlacement placement;
  std::optional<Displacement> error;  // missing if the part was not found

  const domain::Part& part() const { return subject->problem().part(placement.part); }
  const domain::StablePose& resting() const {
    return part().model->stable_poses()[placement.resting.index()];
  }
  bool BreaksPromise() const { return error && !sense::KeepsPromise(subject->promise, *error); }
};

Subject Read(const fs::path& file, const Options& options) {
  Subject subject{.file = file,
                  .scenario = scenario::Load(file, options.models),
                  .promise = {},
                  .workcell_file = {}};
  const domain::Workcell& workcell = *subject.problem().workcell;
  const auto* promise = workcell.uncertainty_operations().FindSensor(kSensor);
  if (promise == nullptr) {
    throw InputError({file.string()},
                     fmt::format("its workcell {} has no sensor {}", workcell.name(), kSensor),
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
  explicit Calibration(const Subject& subject)
      : subject_(subject),
        scene_(subject.problem(), subject.scenario.simulation.scene),
        camera_(scene_, subject.problem()) {}

  Trial Measure(int number) {
    const auto placement =
        sense::DrawCalibrationPlacement(subject_.problem(), subject_.seed, number);
    if (!placement) {
      throw InputError({subject_.file.string()}, "its parts have no room on the table",
                       "fewer parts or a larger table");
    }
    return {&subject_, number, *placement, sense::MeasuredError(scene_, *placement, camera_)};
  }

 private:
  const Subject& subject_;
  const scene::Scene scene_;
  sense::OverheadCamera camera_;
};

std::vector<Trial> MeasureAll(const std::vector<Subject>& subjects, const Options& options) {
  Progress progress("measuring parts");
  const int first = options.trial.value_or(1);
  const int last = options.trial.value_or(options.trials);
  std::vector<Trial> trials;
  for (const Subject& subject : subjects) {
    Calibration calibration(subject);
    for (int number = first; number <= last; ++number) {
      trials.push_back(calibration.Measure(number));
      progress.Tell(fmt::format("{}: {} of {} placements", subject.file.string(),
                                number - first + 1, last - first + 1));
    }
  }
  return trials;
}

// The results of all trials together.
class Result {
 public:
  Result(const Options& options, const std::vector<Subject>& subjects, std::vector<Trial> trials)
      : options_(options), subjects_(subjects), trials_(std::move(trials)) {}

  std::size_t found() const {
    return static_cast<std::size_t>(std::ranges::count_if(trials_, &HasFound));
  }
  bool KeepsPromise() const { return std::ranges::none_of(trials_, &Trial::BreaksPromise); }
  double margin() const { return options_.margin; }

  // Returns the greatest errors, multiplied by the margin.
  SensorPromise Promise() const {
    const double margin = options_.margin;
    return {.x = margin * Greatest(0),
            .y = margin * Greatest(1),
            .z = margin * Greatest(2),
            .theta = margin * Greatest(3)};
  }

  // Returns "10000 placements, seed 1, margin 1.5".
  std::string Note() const {
    std::set<std::uint64_t> seeds;
    for (const Subject& subject : subjects_) seeds.insert(subject.seed);
    return fmt::format("{} placements, seed {}, margin {:g}", found(), fmt::join(seeds, " and "),
                       options_.margin);
  }

  Json ToJson() const {
    Json greatest = Json::object();
    Json promised = Json::object();
    for (std::size_t i = 0; i < kCoordinates.size(); ++i) {
      if (const Trial* worst = Worst(i)) {
        greatest[kCoordinates[i]] = {{"error", Greatest(i)},
                                     {"scenario", worst->subject->file.string()},
                                     {"trial", worst->number}};
      }
      const Interval range = Promised(i);
      if (IsBounded(range)) promised[kCoordinates[i]] = {range.low, range.high};
    }
    Json scenarios = Json::array();
    for (const Subject& subject : subjects_) {
      scenarios.push_back({{"scenario", subject.file.string()}, {"seed", subject.seed}});
    }
    Json failed = Json::array();
    Json not_found = Json::array();
    for (const Trial& trial : trials_) {
      if (trial.BreaksPromise()) failed.push_back(Described(trial));
      if (!HasFound(trial)) not_found.push_back(Described(trial));
    }
    return {{"scenarios", std::move(scenarios)},
            {"sensor", kSensor},
            {"trials", trials_.size()},
            {"found", found()},
            {"greatest_errors", std::move(greatest)},
            {"promised", std::move(promised)},
            {"kept", KeepsPromise()},
            {"margin", options_.margin},
            {"failed", std::move(failed)},
            {"not_found", std::move(not_found)}};
  }

  std::string ForPeople() const {
    Table table({{"error of"},
                 {"greatest", Align::kRight},
                 {"promised", Align::kRight},
                 {"unit"},
                 {"scenario"},
                 {"trial", Align::kRight}});
    for (std::size_t i = 0; i < kCoordinates.size(); ++i) {
      const Trial* const worst = Worst(i);
      if (worst == nullptr) break;
      const Unit& unit = kUnits[i];
      const Interval range = Promised(i);
      table.Add({kCoordinates[i], fmt::format("{:.4f}", Greatest(i) / unit.factor),
                 IsBounded(range) ? RangeText(range, unit) : "nothing", std::string(unit.name),
                 worst->subject->file.stem().string(), std::to_string(worst->number)});
    }
    std::string text = table.Text();
    for (const Trial& trial : trials_) {
      if (trial.BreaksPromise()) text += ForPeople(trial);
    }
    const auto broken = std::ranges::count_if(trials_, &Trial::BreaksPromise);
    return text + NotFoundForPeople() +
           fmt::format(
               "the {} found the part in {} of {} placements, and kept its promise "
               "in {} of these\n",
               kSensor, found(), trials_.size(), found() - broken);
  }

 private:
  static bool HasFound(const Trial& trial) { return trial.error.has_value(); }
  static bool IsBounded(const Interval& range) {
    return std::isfinite(range.low) && std::isfinite(range.high);
  }

  // Returns the trial whose error in this coordinate is greatest, or null if no part was found.
  const Trial* Worst(std::size_t coordinate) const {
    const Trial* worst = nullptr;
    const auto size = [&](const Trial& trial) { return std::abs((*trial.error)[coordinate]); };
    for (const Trial& trial : trials_) {
      if (trial.error && (worst == nullptr || size(trial) > size(*worst))) worst = &trial;
    }
    return worst;
  }
  double Greatest(std::size_t coordinate) const {
    const Trial* worst = Worst(coordinate);
    return worst == nullptr ? 0 : std::abs((*worst->error)[coordinate]);
  }

  // Returns the interval that is within the promises of all workcells.
  Interval Promised(std::size_t coordinate) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Interval narrowest = {-kInfinity, kInfinity};
    for (const Subject& subject : subjects_) {
      const domain::SensorModel& promise = subject.promise;
      const Interval range = std::array{promise.x, promise.y, promise.z, promise.theta}[coordinate];
      narrowest = {std::max(narrowest.low, range.low), std::min(narrowest.high, range.high)};
    }
    return narrowest;
  }

  std::string ReplayCommand(const Trial& trial) const {
    sweep::CommandLine line("calibrate", trial.subject->file);
    line.Add("--seed", trial.subject->seed);
    line.Add("--trial", trial.number);
    line.AddModels(options_.models);
    return line.text();
  }

  static Json Coordinates(const Displacement& displacement) {
    Json json;
    for (std::size_t i = 0; i < kCoordinates.size(); ++i) json[kCoordinates[i]] = displacement[i];
    return json;
  }

  Json Described(const Trial& trial) const {
    const Pose& X_WorldPart = trial.placement.X_WorldPart[trial.placement.part.index()];
    return {{"scenario", trial.subject->file.string()},
            {"trial", trial.number},
            {"part", trial.part().name},
            {"stable_pose", trial.resting().name},
            {"at", {X_WorldPart.translation().x(), X_WorldPart.translation().y()}},
            {"displacement", Coordinates(trial.placement.displacement)},
            {"error", trial.error ? Coordinates(*trial.error) : Json(nullptr)},
            {"again", ReplayCommand(trial)}};
  }

  // Returns how often each part was not found in each pose. A part that is not found breaks no
  // promise.
  std::string NotFoundForPeople() const {
    std::map<std::string, std::vector<const Trial*>> missed;
    for (const Trial& trial : trials_) {
      if (HasFound(trial)) continue;
      missed[fmt::format("{}, {}", trial.part().model->name(), trial.resting().name)].push_back(
          &trial);
    }
    std::string text;
    for (const auto& [what, trials] : missed) {
      text += fmt::format("not found: {}: {} times\nagain: {}\n", what, trials.size(),
                          ReplayCommand(*trials.front()));
    }
    return text;
  }

  std::string ForPeople(const Trial& trial) const {
    return fmt::format("{}, trial {}: {}, {}: the error is greater than promised\nagain: {}\n",
                       trial.subject->file.stem().string(), trial.number, trial.part().name,
                       trial.resting().name, ReplayCommand(trial));
  }

  const Options& options_;
  const std::vector<Subject>& subjects_;
  const std::vector<Trial> trials_;
};

// Returns each workcell file once, in the order of the scenarios.
std::vector<fs::path> WorkcellFiles(const std::vector<Subject>& subjects) {
  std::vector<fs::path> files;
  for (const Subject& subject : subjects) {
    if (std::ranges::count(files, subject.workcell_file) == 0) {
      files.push_back(subject.workcell_file);
    }
  }
  return files;
}

// Returns the text of the workcell's file with the measured promise.
std::string Promising(const fs::path& file, const Result& result) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  return domain::WithPromise(text, file.string(), kSensor, result.Promise(), result.Note());
}

void Write(const std::vector<fs::path>& files, const Result& result) {
  std::vector<std::string> texts;
  for (const fs::path& file : files) texts.push_back(Promising(file, result));
  for (std::size_t i = 0; i < files.size(); ++i) AmendFile(files[i], texts[i]);
}

std::string PromiseForPeople(const Result& result, const std::vector<fs::path>& written) {
  constexpr domain::Units kMetresAndDegrees = {.length = domain::kMetres,
                                               .angle = domain::kDegrees};
  std::string text = fmt::format("{} times the greatest errors, in metres and degrees: {}\n",
                                 result.margin(), PromiseText(result.Promise(), kMetresAndDegrees));
  for (const fs::path& file : written) text += fmt::format("promised in {}\n", file.string());
  return text;
}

ExitCode Execute(const Options& options) {
  std::vector<Subject> subjects;
  for (const fs::path& file : options.scenarios) subjects.push_back(Read(file, options));
  std::vector<fs::path> files;
  if (options.write) files = WorkcellFiles(subjects);
  std::ranges::for_each(files, RequireAmendable);
  const Stopwatch stopwatch;
  const Result result(options, subjects, MeasureAll(subjects, options));
  const bool has_promise = result.found() > 0;
  if (has_promise) Write(files, result);
  Json json = result.ToJson();
  json["seconds"] = stopwatch.Seconds();
  Print(options.json  ? plan::JsonText(json)
        : has_promise ? result.ForPeople() + PromiseForPeople(result, files)
                      : result.ForPeople());
  // A promise that was just written is kept by definition.
  const bool kept = has_promise && (options.write || result.KeepsPromise());
  return kept ? ExitCode::kDone : ExitCode::kFailed;
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command
      .add_option("scenarios", options->scenarios,
                  "scenario files: which parts, on the tables of which workcells")
      ->required();
  command.add_option("--trials", options->trials, "how many placements in each scenario")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_option("--trial", options->trial, "only this one of the placements")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_option("--seed", options->seed, "of the placements; the scenario's if left out")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--margin", options->margin, "what is promised, over the greatest error measured")
      ->check(Within({1, 100}, kRatioUnit));
  command.add_flag("--write", options->write,
                   "write the promise into the workcells' files; nothing else in them changes");
  command.add_flag("--json", options->json, "print the result as JSON, in metres and radians");
  AddModelsOption(command, options->models);
  return [options] { return Execute(*options); };
}

}  // namespace calibrate_verb

const Verb kCalibrate = {
    .name = "calibrate",
    .summary = "measures the camera's errors at random placements against its promise",
    .page = "sim/running.md",
    .example =
        "assay calibrate scenarios/spar-fig15.yaml --trials 1000 --seed 1\n"
        "  assay calibrate scenarios/spar-fig15.yaml scenarios/keyed.yaml --trials 1000 --write",
    .declare = calibrate_verb::Declare,
};

}  // namespace assay::cli
