#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/interval.h"
#include "planner/domain/workcell/sensor_promise.h"
#include "sim/scenario/scenario.h"
#include "sim/sense/calibration.h"

namespace assay::cli {

inline constexpr char kCalibratedSensor[] = "overhead-camera";

// A scenario whose parts are put at random places on its table.
struct CalibratedScenario {
  std::filesystem::path file;
  scenario::Scenario scenario;
  domain::SensorModel promise;
  std::uint64_t seed = 0;
  std::filesystem::path workcell_file;

  const domain::Problem& problem() const { return scenario.problem; }
};

// A part at a random place, and the sensor's error there.
struct CalibrationTrial {
  const CalibratedScenario* scenario = nullptr;
  int number = 0;  // from 1
  sense::CalibrationPlacement placement;
  std::optional<sense::Displacement> error;  // missing if the part was not found

  const domain::Part& part() const { return scenario->problem().part(placement.part); }
  const domain::StablePose& resting() const {
    return part().model->stable_poses()[placement.resting.index()];
  }
  bool BreaksPromise() const { return error && !sense::KeepsPromise(scenario->promise, *error); }
};

// What the trials of a calibration show together about the sensor's promise.
class CalibrationReport {
 public:
  // Keeps a reference to the scenarios, to which the trials point. A promise is `margin` times the
  // greatest error. `models` are the folders of models that commands name.
  CalibrationReport(const std::vector<CalibratedScenario>& scenarios,
                    std::vector<CalibrationTrial> trials, double margin, domain::ModelPath models)
      : scenarios_(scenarios),
        trials_(std::move(trials)),
        margin_(margin),
        models_(std::move(models)) {}

  std::size_t found() const {  // number of trials in which the sensor found the part
    return static_cast<std::size_t>(std::ranges::count_if(trials_, &HasFound));
  }
  bool KeepsPromise() const {
    return std::ranges::none_of(trials_, &CalibrationTrial::BreaksPromise);
  }
  double margin() const { return margin_; }
  // Returns the greatest errors, multiplied by the margin.
  domain::SensorPromise Promise() const;
  // Returns "10000 placements, seed 1, margin 1.5".
  std::string Note() const;
  nlohmann::ordered_json ToJson() const;
  std::string ForPeople() const;

 private:
  static bool HasFound(const CalibrationTrial& trial) { return trial.error.has_value(); }
  // Returns the trial whose error in this coordinate is greatest, or null if no part was found.
  const CalibrationTrial* Worst(std::size_t coordinate) const;
  double Greatest(std::size_t coordinate) const;
  // Returns the interval that is within the promises of all workcells.
  Interval Promised(std::size_t coordinate) const;
  std::string ReplayCommand(const CalibrationTrial& trial) const;
  nlohmann::ordered_json Described(const CalibrationTrial& trial) const;
  // Returns how often each part was not found in each pose. A part that is not found breaks no
  // promise.
  std::string NotFoundForPeople() const;
  std::string ForPeople(const CalibrationTrial& trial) const;

  const std::vector<CalibratedScenario>& scenarios_;
  std::vector<CalibrationTrial> trials_;
  double margin_;
  domain::ModelPath models_;
};

}  // namespace assay::cli
