#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/check/trial_verdicts/trial.h"
#include "sim/noise/error_box.h"
#include "sim/scenario/scenario.h"
#include "sim/sweep/database/records.h"
#include "sim/sweep/database/store.h"
#include "sim/sweep/grid/grid.h"
#include "sim/sweep/shell_commands/run_command.h"

namespace assay::sweep {

// The data that all trials of a cell share.
struct Preparation {
  scenario::Scenario scenario;  // has the cell's clearance, errors and grasp
  plan::Plan plan;
  std::vector<noise::Channel> box;
  check::NoiseFloor gate;
  std::optional<RunCommand> run_command;  // none if `assay run` cannot make the plan
};

// A cell after planning.
struct PlannedCell {
  Cell cell;
  CellRecord record;
  std::shared_ptr<const Preparation> preparation;  // null if there is no plan
};

// The control of a falsification.
struct FalsificationControl {
  int jobs = 1;  // threads; the result does not depend on their number
  // Called by the runner with the number of attempts made so far, by one thread at a time. If it
  // throws, the falsification is broken off.
  std::function<void(std::int64_t)> progress = {};
};

// The operations on cells and trials. All functions can be called from many threads, and depend
// only on their arguments.
struct Work {
  // Makes the plan of a cell and measures the noise floor.
  std::function<PlannedCell(const Cell&)> plan;
  // Restores the plan and the noise floor of a cell from its record.
  std::function<PlannedCell(const Cell&, const CellRecord&)> restore;
  // Runs a trial. `number` is its number in the cell, from 1. The caller sets the fields of the
  // record that say where the trial is in the sweep.
  std::function<TimedTrial(const PlannedCell&, int number)> run;
  // Runs the only trial of a falsification cell.
  std::function<TimedTrial(const PlannedCell&, const FalsificationControl&)> falsification;
};

// Returns the noise floor of a plan in a scene. Any thread may call it.
using NoiseFloorOf = std::function<check::NoiseFloor(
    const domain::Problem& problem, const plan::Plan& plan, const scene::SceneOptions& scene)>;

// Returns the work that plans with the planner and executes in the simulator. `models` are the
// folders of models; empty: each scenario's own. Planning calls `noise_floor`, restoring does not.
Work RealWork(const Sweep& sweep, const domain::ModelPath& models, const NoiseFloorOf& noise_floor);

// Returns the noise of a cell's trial that is not a falsification.
noise::Noise NoiseOf(const PlannedCell& cell, int number);

// Executes a trial of a cell with its noise. `observer` observes the execution and may be null.
// `sample_rate` is that of execution::ExecutorOptions.
check::Trial Execute(const PlannedCell& cell, const noise::Noise& noise,
                     execution::Observer* observer, double sample_rate = 0);
}  // namespace assay::sweep
