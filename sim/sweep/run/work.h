#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/check/trial/noisy_trial.h"
#include "sim/noise/error_box.h"
#include "sim/scenario/scenario.h"
#include "sim/sweep/run/grid.h"
#include "sim/sweep/store/records.h"
#include "sim/sweep/store/store.h"

namespace assay::sweep {

// What the trials of a cell have in common.
struct Preparation {
  scenario::Scenario scenario;  // with the cell's clearance, errors and grasp
  plan::Plan plan;
  std::vector<noise::Channel> box;
  check::NoiseFloor gate;
  std::string run_command;  // "assay run ...", that makes the same plan; empty:
                            // none does
};

// A cell whose plan is made.
struct PlannedCell {
  Cell cell;
  CellRecord record;
  std::shared_ptr<const Preparation> preparation;  // if there is a plan
};

// How an attack is made.
struct AttackControl {
  int jobs = 1;  // threads; they change nothing
  // Told of how many attempts were made so far, from one thread at a time. If it throws, the attack
  // is broken off.
  std::function<void(std::int64_t)> progress = {};
};

// What is done for cells and trials. All functions can be called from many threads, and depend on
// nothing but their arguments.
struct Work {
  // Makes the plan and measures the honesty gate.
  std::function<PlannedCell(const Cell&)> plan;
  // The same from what is stored.
  std::function<PlannedCell(const Cell&, const CellRecord&)> restore;
  // `number`: of the trial in its cell, from 1. The record's numbers in the sweep are filled in by
  // who calls.
  std::function<TimedTrial(const PlannedCell&, int number)> run;
  // The only trial of a cell that is attacked.
  std::function<TimedTrial(const PlannedCell&, const AttackControl&)> attack;
};

// Plans with the planner, executes in physics. `models`: the folder; empty: each scenario's own.
Work RealWork(const Sweep& sweep, const domain::ModelPath& models);

// The noise of a trial, which is no attack.
noise::Noise NoiseOf(const PlannedCell& cell, int number);

// A trial with its noise. `observer`: looks on, unless it is null.
check::NoisyTrial Execute(const PlannedCell& cell, const noise::Noise& noise,
                          exec::Observer* observer);
}  // namespace assay::sweep
