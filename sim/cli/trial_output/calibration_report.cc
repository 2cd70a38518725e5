#include "sim/cli/trial_output/calibration_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "sim/cli/options/quantity.h"
#include "sim/cli/plan_output/table.h"
#include "sim/sweep/shell_commands/shell.h"

namespace assay::cli {
namespace {

// Returns the name of a stable pose in the part's file, or its label if it has no name.
const std::string& NameOf(const domain::StablePose& pose) {
  return pose.name.empty() ? pose.label : pose.name;
}

using Json = nlohmann::ordered_json;
using geometry::Pose;

constexpr std::array kErrorCoordinates = {"x", "y", "z", "theta"};  // coordinates of a displacement
constexpr std::array kErrorUnits = {kLengthUnit, kLengthUnit, kLengthUnit, kAngleUnit};

bool IsBounded(const Interval& range) {
  return std::isfinite(range.low) && std::isfinite(range.high);
}

Json Coordinates(const sense::Displacement& displacement) {
  Json json;
  for (std::size_t i = 0; i < kErrorCoordinates.size(); ++i)
    json[kErrorCoordinates[i]] = displacement[i];
  return json;
}

}  // namespace

domain::SensorPromise CalibrationReport::Promise() const {
  return {.x = margin_ * Greatest(0),
          .y = margin_ * Greatest(1),
          .z = margin_ * Greatest(2),
          .theta = margin_ * Greatest(3)};
}

std::string CalibrationReport::Note() const {
  std::set<std::uint64_t> seeds;
  for (const CalibratedScenario& scenario : scenarios_) seeds.insert(scenario.seed);
  return fmt::format("{} placements, seed {}, margin {:g}", found(), fmt::join(seeds, " and "),
                     margin_);
}

Json CalibrationReport::ToJson() const {
  Json greatest = Json::object();
  Json promised = Json::object();
  for (std::size_t i = 0; i < kErrorCoordinates.size(); ++i) {
    if (const CalibrationTrial* worst = Worst(i)) {
      greatest[kErrorCoordinates[i]] = {{"error", Greatest(i)},
                                        {"scenario", worst->scenario->file.string()},
                                        {"trial", worst->number}};
    }
    const Interval range = Promised(i);
    if (IsBounded(range)) promised[kErrorCoordinates[i]] = {range.low, range.high};
  }
  Json scenarios = Json::array();
  for (const CalibratedScenario& scenario : scenarios_) {
    scenarios.push_back({{"scenario", scenario.file.string()}, {"seed", scenario.seed}});
  }
  Json failed = Json::array();
  Json not_found = Json::array();
  for (const CalibrationTrial& trial : trials_) {
    if (trial.BreaksPromise()) failed.push_back(Described(trial));
    if (!HasFound(trial)) not_found.push_back(Described(trial));
  }
  return {{"scenarios", std::move(scenarios)},
          {"sensor", kCalibratedSensor},
          {"trials", trials_.size()},
          {"found", found()},
          {"greatest_errors", std::move(greatest)},
          {"promised", std::move(promised)},
          {"kept", KeepsPromise()},
          {"margin", margin_},
          {"failed", std::move(failed)},
          {"not_found", std::move(not_found)}};
}

std::string CalibrationReport::ForPeople() const {
  Table table({{"error of"},
               {"greatest", Align::kRight},
               {"promised", Align::kRight},
               {"unit"},
               {"scenario"},
               {"trial", Align::kRight}});
  for (std::size_t i = 0; i < kErrorCoordinates.size(); ++i) {
    const CalibrationTrial* const worst = Worst(i);
    if (worst == nullptr) break;
    const Unit& unit = kErrorUnits[i];
    const Interval range = Promised(i);
    table.Add({kErrorCoordinates[i], fmt::format("{:.4f}", Greatest(i) / unit.factor),
               IsBounded(range) ? RangeText(range, unit) : "nothing", std::string(unit.name),
               worst->scenario->file.stem().string(), std::to_string(worst->number)});
  }
  std::string text = table.Text();
  for (const CalibrationTrial& trial : trials_) {
    if (trial.BreaksPromise()) text += ForPeople(trial);
  }
  const auto broken = std::ranges::count_if(trials_, &CalibrationTrial::BreaksPromise);
  return text + NotFoundForPeople() +
         fmt::format(
             "the {} found the part in {} of {} placements, and kept its promise "
             "in {} of these\n",
             kCalibratedSensor, found(), trials_.size(), found() - broken);
}

const CalibrationTrial* CalibrationReport::Worst(std::size_t coordinate) const {
  const CalibrationTrial* worst = nullptr;
  const auto size = [&](const CalibrationTrial& trial) {
    return std::abs((*trial.error)[coordinate]);
  };
  for (const CalibrationTrial& trial : trials_) {
    if (trial.error && (worst == nullptr || size(trial) > size(*worst))) worst = &trial;
  }
  return worst;
}

double CalibrationReport::Greatest(std::size_t coordinate) const {
  const CalibrationTrial* worst = Worst(coordinate);
  return worst == nullptr ? 0 : std::abs((*worst->error)[coordinate]);
}

Interval CalibrationReport::Promised(std::size_t coordinate) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Interval narrowest = {-kInfinity, kInfinity};
  for (const CalibratedScenario& scenario : scenarios_) {
    const domain::SensorModel& promise = scenario.promise;
    const Interval range = std::array{promise.x, promise.y, promise.z, promise.theta}[coordinate];
    narrowest = {std::max(narrowest.low, range.low), std::min(narrowest.high, range.high)};
  }
  return narrowest;
}

std::string CalibrationReport::ReplayCommand(const CalibrationTrial& trial) const {
  sweep::CommandLine line("calibrate", trial.scenario->file);
  line.Add("--seed", trial.scenario->seed);
  line.Add("--trial", trial.number);
  line.AddModels(models_);
  return line.text();
}

Json CalibrationReport::Described(const CalibrationTrial& trial) const {
  const Pose& X_WorldPart = trial.placement.X_WorldPart[trial.placement.part.index()];
  return {{"scenario", trial.scenario->file.string()},
          {"trial", trial.number},
          {"part", trial.part().name},
          {"stable_pose", NameOf(trial.resting())},
          {"at", {X_WorldPart.translation().x(), X_WorldPart.translation().y()}},
          {"displacement", Coordinates(trial.placement.displacement)},
          {"error", trial.error ? Coordinates(*trial.error) : Json(nullptr)},
          {"again", ReplayCommand(trial)}};
}

std::string CalibrationReport::NotFoundForPeople() const {
  std::map<std::string, std::vector<const CalibrationTrial*>> missed;
  for (const CalibrationTrial& trial : trials_) {
    if (HasFound(trial)) continue;
    missed[fmt::format("{}, {}", trial.part().model->name(), NameOf(trial.resting()))].push_back(
        &trial);
  }
  std::string text;
  for (const auto& [what, trials] : missed) {
    text += fmt::format("not found: {}: {} times\nto repeat one: {}\n", what, trials.size(),
                        ReplayCommand(*trials.front()));
  }
  return text;
}

std::string CalibrationReport::ForPeople(const CalibrationTrial& trial) const {
  return fmt::format("{}, trial {}: {}, {}: the error is greater than promised\nto repeat it: {}\n",
                     trial.scenario->file.stem().string(), trial.number, trial.part().name,
                     NameOf(trial.resting()), ReplayCommand(trial));
}

}  // namespace assay::cli
