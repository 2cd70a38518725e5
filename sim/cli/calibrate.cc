#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/input_error.h"
#include "planner/plan/json_layout.h"
#include "sim/cli/console.h"
#include "sim/cli/planned_problem.h"
#include "sim/cli/progress.h"
#include "sim/cli/quantity.h"
#include "sim/cli/stopwatch.h"
#include "sim/cli/table.h"
#include "sim/cli/verb.h"
#include "sim/sense/calibration.h"
#include "sim/sense/overhead_camera.h"

namespace assay::cli {
namespace calibrate_verb {

using Json = nlohmann::ordered_json;
using geometry::Pose;
using sense::CalibrationPlacement;
using sense::Displacement;

constexpr char kSensor[] = "overhead-camera";
constexpr std::array kCoordinates = {"x", "y", "z", "theta"};  // of a displacement
constexpr std::array kUnits = {kLengthUnit, kLengthUnit, kLengthUnit, kAngleUnit};

struct Options {
  std::filesystem::path input;
  std::filesystem::path models;
  int trials = 100;
  std::optional<int> trial;  // the only one
  std::optional<std::uint64_t> seed;
  bool json = false;
};

struct Trial {
  int number = 0;  // from 1
  CalibrationPlacement placement;
  std::optional<Displacement> error;  // None: the part was not found
};

const domain::SensorModel& PromiseOf(const domain::Problem& problem, const Options& options) {
  const auto* promise = problem.workcell->uncertainty_operations().FindSensor(kSensor);
  if (promise != nullptr) return *promise;
  throw InputError(
      {options.input.string()},
      fmt::format("its workcell {} has no sensor {}", problem.workcell->name(), kSensor),
      "a workcell that has it");
}

class Calibration {
 public:
  Calibration(const Options& options, const scenario::Scenario& scenario)
      : options_(options),
        problem_(scenario.problem),
        promise_(PromiseOf(problem_, options)),
        seed_(options.seed.value_or(scenario.simulation.seed)),
        scene_(problem_, scenario.simulation.scene),
        camera_(scene_, problem_) {}

  ExitCode Execute() {
    MeasureAll();
    Json result = Result();
    result["seconds"] = stopwatch_.Seconds();
    Print(options_.json ? plan::JsonText(result) : ForPeople());
    return Failed().empty() ? ExitCode::kDone : ExitCode::kFailed;
  }

 private:
  void MeasureAll() {
    Progress progress("measuring parts");
    const int first = options_.trial.value_or(1);
    const int last = options_.trial.value_or(options_.trials);
    for (int number = first; number <= last; ++number) {
      trials_.push_back(Measure(number));
      progress.Tell(fmt::format("{} of {} placements", number - first + 1, last - first + 1));
    }
  }

  Trial Measure(int number) {
    const auto placement = sense::DrawCalibrationPlacement(problem_, seed_, number);
    if (!placement) {
      throw InputError({options_.input.string()}, "its parts have no room on the table",
                       "fewer parts or a larger table");
    }
    return {number, *placement, sense::MeasuredError(scene_, *placement, camera_)};
  }

  bool HasFailed(const Trial& trial) const {
    return !trial.error || !sense::KeepsPromise(promise_, *trial.error);
  }
  std::vector<const Trial*> Failed() const {
    std::vector<const Trial*> failed;
    for (const Trial& trial : trials_) {
      if (HasFailed(trial)) failed.push_back(&trial);
    }
    return failed;
  }

  // The trial whose error in this coordinate is greatest; null if no part was found.
  const Trial* Worst(std::size_t coordinate) const {
    const Trial* worst = nullptr;
    const auto size = [&](const Trial& trial) { return std::abs((*trial.error)[coordinate]); };
    for (const Trial& trial : trials_) {
      if (trial.error && (worst == nullptr || size(trial) > size(*worst))) worst = &trial;
    }
    return worst;
  }

  const Interval& Promised(std::size_t coordinate) const {
    return *std::array{&promise_.x, &promise_.y, &promise_.z, &promise_.theta}[coordinate];
  }

  std::string ReplayCommand(const Trial& trial) const {
    return fmt::format(
        "assay calibrate {} --seed {} --trial {}{}", options_.input.string(), seed_, trial.number,
        options_.models.empty() ? "" : fmt::format(" --models {}", options_.models.string()));
  }

  const domain::StablePose& RestingPose(const Trial& trial) const {
    const domain::PartModel& model = *problem_.part(trial.placement.part).model;
    return model.stable_poses()[trial.placement.resting.index()];
  }

  static Json Coordinates(const Displacement& displacement) {
    Json json;
    for (std::size_t i = 0; i < kCoordinates.size(); ++i) json[kCoordinates[i]] = displacement[i];
    return json;
  }

  Json ToJson(const Trial& trial) const {
    const Pose& X_WorldPart = trial.placement.X_WorldPart[trial.placement.part.index()];
    return {{"trial", trial.number},
            {"part", problem_.part(trial.placement.part).name},
            {"stable_pose", RestingPose(trial).name},
            {"at", {X_WorldPart.translation().x(), X_WorldPart.translation().y()}},
            {"displacement", Coordinates(trial.placement.displacement)},
            {"error", trial.error ? Coordinates(*trial.error) : Json(nullptr)},
            {"again", ReplayCommand(trial)}};
  }

  Json Result() const {
    Json greatest = Json::object();
    Json promised = Json::object();
    for (std::size_t i = 0; i < kCoordinates.size(); ++i) {
      if (const Trial* worst = Worst(i)) {
        greatest[kCoordinates[i]] = {{"error", std::abs((*worst->error)[i])},
                                     {"trial", worst->number}};
      }
      const Interval& range = Promised(i);
      if (std::isfinite(range.low) && std::isfinite(range.high)) {
        promised[kCoordinates[i]] = {range.low, range.high};
      }
    }
    Json failed = Json::array();
    for (const Trial* trial : Failed()) failed.push_back(ToJson(*trial));
    return {{"scenario", options_.input.string()},
            {"sensor", kSensor},
            {"seed", seed_},
            {"trials", trials_.size()},
            {"found", std::ranges::count_if(trials_, [](const Trial& t) { return !!t.error; })},
            {"greatest_errors", std::move(greatest)},
            {"promised", std::move(promised)},
            {"kept", failed.empty()},
            {"failed", std::move(failed)}};
  }

  std::string ForPeople() const {
    Table table({{"error of"},
                 {"greatest", Align::kRight},
                 {"promised", Align::kRight},
                 {"unit"},
                 {"trial", Align::kRight}});
    for (std::size_t i = 0; i < kCoordinates.size(); ++i) {
      const Trial* const worst = Worst(i);
      if (worst == nullptr) break;
      const Unit& unit = kUnits[i];
      const bool promised = std::isfinite(Promised(i).low) && std::isfinite(Promised(i).high);
      table.Add({kCoordinates[i], fmt::format("{:.4f}", std::abs((*worst->error)[i]) * unit.scale),
                 promised ? RangeText(Promised(i), unit) : "nothing", unit.name,
                 std::to_string(worst->number)});
    }
    std::string text = table.Text();
    const std::vector<const Trial*> failed = Failed();
    for (const Trial* trial : failed) text += ForPeople(*trial);
    return text + fmt::format("the {} kept its promise in {} of {} placements\n", kSensor,
                              trials_.size() - failed.size(), trials_.size());
  }

  std::string ForPeople(const Trial& trial) const {
    return fmt::format("trial {}: {}, {}: {}\nagain: {}\n", trial.number,
                       problem_.part(trial.placement.part).name, RestingPose(trial).name,
                       trial.error ? "the error is greater than promised" : "not found",
                       ReplayCommand(trial));
  }

  const Options& options_;
  const domain::Problem& problem_;
  const domain::SensorModel& promise_;
  const std::uint64_t seed_;
  const scene::Scene scene_;
  sense::OverheadCamera camera_;
  const Stopwatch stopwatch_;
  std::vector<Trial> trials_;
};

ExitCode Execute(const Options& options) {
  const scenario::Scenario scenario = scenario::Load(options.input, options.models);
  return Calibration(options, scenario).Execute();
}

Execution Declare(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("scenario", options->input, "scenario file: which parts, on which table")
      ->required();
  command.add_option("--trials", options->trials, "how many placements")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_option("--trial", options->trial, "only this one of the placements")
      ->check(CLI::Range(1, std::numeric_limits<int>::max()));
  command.add_option("--seed", options->seed, "of the placements; the scenario's if left out")
      ->check(CLI::NonNegativeNumber);
  command.add_flag("--json", options->json, "print the result as JSON, in metres and radians");
  command.add_option("--models", options->models, "folder with parts/ and workcells/")
      ->check(CLI::ExistingDirectory);
  return [options] { return Execute(*options); };
}

}  // namespace calibrate_verb

const Verb kCalibrate = {
    .name = "calibrate",
    .summary = "measures the camera's errors at random placements against its promise",
    .example = "assay calibrate scenarios/spar-fig15.yaml --trials 1000 --seed 1",
    .declare = calibrate_verb::Declare,
};

}  // namespace assay::cli
