#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "planner/domain/workcell/model_path.h"
#include "sim/cli/command_line/exit_code.h"
#include "sim/cli/plan_output/report.h"
#include "sim/sweep/database/store.h"
#include "sim/sweep/database/summary.h"
#include "sim/sweep/grid/sweep_file.h"

namespace assay::cli {

// A falsification in the database of a sweep.
struct CellFalsification {
  int cell = 0;
  sweep::FalsificationRecord falsification;
};

// The content of the database of a sweep.
struct SweepResults {
  std::string database;  // path, as the user gave it
  int trials = 0;        // number of trials of the whole sweep
  std::vector<sweep::CellSummary> cells = {};
  std::vector<CellFalsification> falsifications = {};  // in the order of the cells
  // Runs that finished trials other than falsifications.
  std::vector<sweep::RunRecord> runs = {};
  // The number of the first trial that failed or violated a prediction; 0 if none did.
  int first_bad = 0;

  int Done() const;
  int Succeeded() const;
  check::VerdictCounts Certificates() const;
};
SweepResults ResultsOf(const sweep::Store& store, const std::string& database);

// Returns a text for people: for each cell the rate of success with its 95 % interval and the
// counts of verdicts, then falsifications with their counterexamples, then the speed.
std::string ForPeople(const SweepResults& results);
// Returns an object by sweep.schema.json.
nlohmann::ordered_json ToJson(const SweepResults& results);

// Returns the code for failure if a trial failed, a prediction was violated or a plan cannot be
// tested. Otherwise returns the code for no plan if a cell has none, or the code for success.
ExitCode ExitCodeOf(const SweepResults& results);

// Reports the grid of a sweep file. Throws InputError if one of its scenarios is wrong.
Report ReportOn(const sweep::Sweep& sweep, const domain::ModelPath& models);

}  // namespace assay::cli
